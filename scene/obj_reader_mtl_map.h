#pragma once

#include <string_view>

namespace encore::scene {

/// What a texture statement of an MTL file (map_Kd and the like) says behind its keyword.
struct MtlMap {
  std::string_view file;     ///< as stated, with its blanks; empty if none is named
  bool transformed = false;  ///< -o, -s or -t move, scale or disturb the coordinates
};

/// Options go before the file name: those of the format (-blendu -blendv -bm -boost -cc -clamp
/// -imfchan -mm -o -s -t -texres -type) and -colorspace are skipped with their arguments, of which
/// -o, -s and -t take one to three numbers. What begins with another minus is the name.
MtlMap parse_mtl_map(std::string_view arguments);

}  // namespace encore::scene
