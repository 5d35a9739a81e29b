#include "scene/ray_settings.h"

#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace encore::scene {
namespace {

constexpr std::array<std::string_view, 4> kKeys{"rays", "samples", "depth", "seed"};
constexpr std::array<std::string_view, 4> kWords{"shadows", "reflections", "refractions",
                                                 "textures"};

std::array<bool*, 4> switches(RaySettings& settings) {
  return {&settings.shadows, &settings.reflections, &settings.refractions, &settings.textures};
}

std::string unknown_rays(std::string_view word) {
  return fmt::format("unknown rays '{}'; there are {}, all and none{}", word,
                     fmt::join(kWords, ", "), did_you_mean(word, kWords));
}

std::string apply_rays(RaySettings& settings, std::string_view list) {
  RaySettings wanted = settings;
  for (bool* on : switches(wanted)) *on = list == "all";
  if (list != "all" && list != "none") {
    for (std::size_t start = 0; start <= list.size();) {
      const std::size_t end = std::min(list.find(',', start), list.size());
      const std::string_view word = list.substr(start, end - start);
      bool known = false;
      for (std::size_t i = 0; i < kWords.size(); ++i) {
        if (kWords[i] != word) continue;
        *switches(wanted)[i] = true;
        known = true;
      }
      if (!known) return unknown_rays(word);
      start = end + 1;
    }
  }
  settings = wanted;
  return {};
}

template <class Number>
std::string apply_number(Number& target, std::string_view key, std::string_view text, Number low,
                         Number high) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high) {
    return fmt::format("'{}' is not a value for {}; it takes a whole number from {} to {}", text,
                       key, low, high);
  }
  target = value;
  return {};
}

}  // namespace

std::string_view to_string(RayKind kind) {
  switch (kind) {
    case RayKind::camera:
      return "camera";
    case RayKind::shadow:
      return "shadow";
    case RayKind::reflection:
      return "reflection";
    case RayKind::refraction:
      return "refraction";
  }
  return "";
}

std::span<const std::string_view> ray_setting_keys() {
  return kKeys;
}

std::string apply_ray_setting(RaySettings& settings, std::string_view key, std::string_view value) {
  if (key == "rays") return apply_rays(settings, value);
  if (key == "samples") return apply_number(settings.samples, key, value, 1, kMostSamples);
  if (key == "depth") return apply_number(settings.depth, key, value, 0, kMostDepth);
  if (key == "seed") {
    return apply_number<std::uint32_t>(settings.seed, key, value, 0, 0xFFFFFFFFU);
  }
  return fmt::format("unknown setting '{}'; there are {}{}", key, fmt::join(kKeys, ", "),
                     did_you_mean(key, kKeys));
}

std::string ray_list(const RaySettings& settings) {
  RaySettings copy = settings;
  std::string list;
  const auto on = switches(copy);
  for (std::size_t i = 0; i < kWords.size(); ++i) {
    if (*on[i]) list += (list.empty() ? "" : ",") + std::string(kWords[i]);
  }
  return list.empty() ? "none" : list;
}

}  // namespace encore::scene
