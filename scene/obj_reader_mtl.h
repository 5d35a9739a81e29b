#pragma once

#include "scene/diagnostics.h"
#include "scene/material.h"

#include <map>
#include <string>
#include <string_view>

namespace encore::scene {

using MaterialsByName = std::map<std::string, Material, std::less<>>;

/// Reads the materials of an MTL file with tinyobjloader into `materials`; a name that is already
/// there keeps its first meaning. Read are newmtl, Ka, Kd, Ks, Ke, Ns, Ni, d, Tr and illum (d wins
/// over Tr); what a material does not state keeps the default of Material. Colours and numbers are
/// brought into their ranges. `illum` 3 to 7 (mirrors and glass) sets the reflectivity to the mean
/// of Ks. Never throws InputError: a broken file is a warning.
void read_mtl(std::string_view text, const std::string& name, MaterialsByName& materials,
              Warnings& warnings);

}  // namespace encore::scene
