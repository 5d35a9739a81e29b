#include "app/window/widget_map_file.h"

#include "ui/widget_map.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>

namespace encore::app {

void write_widget_map(const std::string& file, std::uint64_t frame, bool busy) {
  const std::string beside = file + ".part";
  {
    std::ofstream out(beside, std::ios::binary | std::ios::trunc);
    out << fmt::format("frame\t{}\t{}\n", frame, busy ? "busy" : "idle") << ui::widget_map_text();
    if (!out) return;
  }
  std::rename(beside.c_str(), file.c_str());
}

}  // namespace encore::app
