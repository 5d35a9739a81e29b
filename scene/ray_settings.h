#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace encore::scene {

/// Which rays a picture is made of, beyond one through the centre of each pixel. The defaults are
/// the thesis' ray casting.
struct RaySettings {
  bool shadows = false;      ///< a light that something stands in front of adds nothing (any-hit)
  bool reflections = false;  ///< mirrors, and what glass mirrors
  bool refractions = false;  ///< what is seen through glass
  bool textures = true;      ///< diffuse textures, where a model has them
  /// Reflections and refractions one after the other on a ray's way; at the limit a surface shows
  /// its own colour only. 0 … kMostDepth.
  int depth = 4;
  /// Camera rays a pixel, 1 … kMostSamples. One goes through the pixel's centre; more are
  /// stratified over it.
  int samples = 1;
  std::uint32_t seed = 1;  ///< of the samples' places

  friend bool operator==(const RaySettings&, const RaySettings&) = default;
};

inline constexpr int kMostDepth = 16;
inline constexpr int kMostSamples = 4096;

/// The kinds of rays, which are counted and timed apart.
enum class RayKind : std::uint8_t { camera, shadow, reflection, refraction };
inline constexpr std::size_t kRayKinds = 4;
std::string_view to_string(RayKind kind);

/// The names that apply_ray_setting knows: rays, samples, depth, seed.
std::span<const std::string_view> ray_setting_keys();

/// Sets one setting by its name. `rays` takes a list ("shadows,reflections,refractions,textures"),
/// "all", or "none" and says of all four whether they are on; the others take a number. Returns an
/// empty string, or what is wrong.
std::string apply_ray_setting(RaySettings& settings, std::string_view key, std::string_view value);

/// "none", or what is on in the order of the struct: "shadows,reflections".
std::string ray_list(const RaySettings& settings);

}  // namespace encore::scene
