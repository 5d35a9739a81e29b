#pragma once

#include "app/window/background_task.h"
#include "energy/csv.h"
#include "energy/session.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace encore::app {

/// Reads the CSV files of a session one after the other, a stretch at a time: a file of millions of
/// rows is never in memory as text, and reading it can be stopped.
class SessionStream {
 public:
  /// `bytes`: of all files that will be read, for the progress.
  SessionStream(TaskControl& control, std::uint64_t bytes) : control_(control), bytes_(bytes) {}

  /// Is told the header and one record, row by row.
  using OnRecord = std::function<void(const energy::CsvRecord&, const energy::CsvRecord&)>;
  /// Reads one file. A row cut off at the end is left out, and a remark says so; so does one about
  /// a file without a header, which a program killed in its first moment leaves. Throws
  /// energy::SessionError, what `on_record` throws with the place put before it.
  void read(const std::filesystem::path& file, const OnRecord& on_record);
  /// The same for files whose columns are always these.
  void read(const std::filesystem::path& file, const energy::CsvRecord& columns,
            const OnRecord& on_record);

  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  void check_stop() const;

  TaskControl& control_;
  std::uint64_t bytes_;
  std::uint64_t done_ = 0;
  std::vector<std::string> remarks_;
};

}  // namespace encore::app
