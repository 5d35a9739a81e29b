#include "scene/obj_reader_mtl_map.h"

#include "scene/model_number.h"

#include <algorithm>

namespace encore::scene {
namespace {

struct Option {
  std::string_view name;
  int words;    ///< that always follow
  int numbers;  ///< that may follow these
};
constexpr Option kOptions[] = {
    {"-blendu", 1, 0}, {"-blendv", 1, 0},  {"-bm", 1, 0},   {"-boost", 1, 0},     {"-cc", 1, 0},
    {"-clamp", 1, 0},  {"-imfchan", 1, 0}, {"-mm", 2, 0},   {"-o", 1, 2},         {"-s", 1, 2},
    {"-t", 1, 2},      {"-texres", 1, 0},  {"-type", 1, 0}, {"-colorspace", 1, 0}};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

MtlMap parse_mtl_map(std::string_view arguments) {
  MtlMap map;
  while (true) {
    std::string_view rest = arguments;
    const std::string_view word = take_token(rest);
    const auto* option = std::find_if(std::begin(kOptions), std::end(kOptions),
                                      [&word](const Option& o) { return o.name == word; });
    if (option == std::end(kOptions)) break;
    for (int i = 0; i < option->words; ++i) take_token(rest);
    for (int i = 0; i < option->numbers; ++i) {
      std::string_view behind = rest;
      float value = 0.0F;
      if (!parse_number(take_token(behind), value)) break;
      rest = behind;
    }
    map.transformed = map.transformed || option->numbers > 0;
    arguments = rest;
  }
  map.file = trimmed(arguments);
  // Some programs quote names with blanks.
  if (map.file.size() >= 2 && map.file.front() == '"' && map.file.back() == '"') {
    map.file = map.file.substr(1, map.file.size() - 2);
  }
  return map;
}

}  // namespace encore::scene
