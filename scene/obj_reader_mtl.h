#pragma once

#include "scene/diagnostics.h"
#include "scene/material.h"

#include <map>
#include <string>
#include <string_view>

namespace encore::scene {

/// A material whose texture, if it names one, is not read yet.
struct MtlMaterial : Material {
  std::string texture;  ///< the file that map_Kd names, as stated; relative to the MTL file
  std::string file;     ///< the MTL file
};

using MaterialsByName = std::map<std::string, MtlMaterial, std::less<>>;

/// Reads the materials of an MTL file with tinyobjloader into `materials`; a name that is already
/// there keeps its first meaning. Read are newmtl, Ka, Kd, Ks, Ke, Ns, Ni, Tf, d, Tr, illum and
/// map_Kd (d wins over Tr); what a material does not state keeps the default of Material, but a
/// texture without Kd has 0.6, as tinyobjloader has it. Colours and numbers are brought into their
/// ranges. Never throws InputError: a broken file is a warning.
///
/// `illum` 3, 5 and 8 are mirrors: the reflectivity is the mean of Ks. 4, 6, 7 and 9 are glass,
/// which mirrors by Fresnel's equations instead (its reflectivity is 0, Ks colours highlights
/// only). Glass whose d says that it is opaque is clear (opacity 0): exporters leave d at 1 and
/// mean the filter Tf to speak, which has no counterpart here, but Tf 0 lets nothing through.
void read_mtl(std::string_view text, const std::string& name, MaterialsByName& materials,
              Warnings& warnings);

}  // namespace encore::scene
