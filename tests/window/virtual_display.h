#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

struct _XDisplay;

namespace encore::test {

/// A screen that nobody sees: an X server of its own, without a window manager. It ends with the
/// object, and with the test program however that ends.
class VirtualDisplay {
 public:
  /// Throws std::runtime_error that says what is missing.
  VirtualDisplay(int width, int height);
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }  ///< ":99"
  [[nodiscard]] _XDisplay* connection() const { return connection_; }

 private:
  pid_t server_ = -1;
  std::string name_;
  _XDisplay* connection_ = nullptr;
};

/// A virtual display; null, with `why`, where there can be none.
std::unique_ptr<VirtualDisplay> try_virtual_display(int width, int height, std::string& why);

}  // namespace encore::test
