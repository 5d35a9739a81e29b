#include "ui/undo.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace encore::ui {

namespace {

/// "pane CPU", or "left pane" where the device does not tell them apart.
std::string pane_name(const Settings& settings, std::size_t pane) {
  const PaneDevice device = settings.panes[pane].device;
  if (device == PaneDevice::off || settings.panes[0].device == settings.panes[1].device) {
    return pane == 0 ? "left pane" : "right pane";
  }
  if (device == PaneDevice::raster) return "raster pane";
  return device == PaneDevice::cpu ? "pane CPU" : "pane GPU";
}

std::string size_text(const PaneSettings& pane) {
  if (pane.size == SizeChoice::custom) {
    return fmt::format("{} x {}", pane.custom_width, pane.custom_height);
  }
  return std::string(to_string(pane.size));
}

bool same_size(const PaneSettings& a, const PaneSettings& b) {
  return a.size == b.size && a.custom_width == b.custom_width && a.custom_height == b.custom_height;
}

void pane_changes(const Settings& before, const Settings& after, std::size_t pane,
                  std::vector<std::string>& names) {
  const PaneSettings& a = before.panes[pane];
  const PaneSettings& b = after.panes[pane];
  const std::string name = pane_name(after, pane);
  if (a.device != b.device) {
    names.push_back(fmt::format("device of the {} pane: {}", pane == 0 ? "left" : "right",
                                to_string(b.device)));
  }
  if (a.content != b.content) names.push_back(fmt::format("{}: {}", name, to_string(b.content)));
  if (a.structure.kind != b.structure.kind) {
    names.push_back(fmt::format("structure of {}: {}", name, to_string(b.structure.kind)));
  } else if (a.structure.intersection != b.structure.intersection) {
    names.push_back(
        fmt::format("intersection of {}: {}", name, to_string(b.structure.intersection)));
  } else if (a.structure.grouping != b.structure.grouping) {
    names.push_back(fmt::format("ray grouping of {}: {}", name, to_string(b.structure.grouping)));
  } else if (a.structure.memory != b.structure.memory) {
    names.push_back(fmt::format("memory of {}: {}", name, to_string(b.structure.memory)));
  } else if (a.structure != b.structure) {
    names.push_back(fmt::format("parameters of {}, {}", to_string(b.structure.kind), name));
  }
  if (a.policy != b.policy) {
    names.push_back(fmt::format("policy of {}: {}", name, to_string(b.policy)));
  }
  if (a.build_on != b.build_on) {
    names.push_back(fmt::format("structure of {} built on: {}", name, to_string(b.build_on)));
  }
  if (!same_size(a, b)) names.push_back(fmt::format("size of {}: {}", name, size_text(b)));
  if (a.threads != b.threads) {
    names.push_back(b.threads == 0 ? fmt::format("threads of {}: all", name)
                                   : fmt::format("threads of {}: {}", name, b.threads));
  }
}

std::string rays_change(const scene::RaySettings& a, const scene::RaySettings& b) {
  if (scene::ray_list(a) != scene::ray_list(b)) return "rays: " + scene::ray_list(b);
  if (a.samples != b.samples) return fmt::format("samples: {}", b.samples);
  if (a.depth != b.depth) return fmt::format("depth of rays: {}", b.depth);
  return fmt::format("seed of samples: {}", b.seed);
}

std::string overlay_change(const OverlaySettings& a, const OverlaySettings& b) {
  if (a.show != b.show) return b.show ? "overlay: on" : "overlay: off";
  if (a.color != b.color) return fmt::format("overlay's colour: {}", to_string(b.color));
  if (a.hidden != b.hidden) return fmt::format("hidden lines: {}", to_string(b.hidden));
  if (a.section != b.section) return b.section ? "section: on" : "section: off";
  if (a.first_depth != b.first_depth || a.last_depth != b.last_depth) {
    return fmt::format("overlay's depths: {} to {}", b.first_depth, b.last_depth);
  }
  return "overlay";
}

std::string heatmap_change(const HeatmapSettings& a, const HeatmapSettings& b) {
  if (a.cost != b.cost) return fmt::format("heatmap: {}", to_string(b.cost));
  return "heatmap's scale";
}

std::string energy_change(const EnergySettings& a, const EnergySettings& b) {
  if (a.from == b.from && a.source == b.source) return "watts of the model";
  if (b.from == EnergySettings::From::chosen) return fmt::format("energy source: {}", b.source);
  return fmt::format("energy source: {}", to_string(b.from));
}

/// All but whether it plays.
bool same_animation(AnimationSettings a, const AnimationSettings& b) {
  a.playing = b.playing;
  return a == b;
}

}  // namespace

std::string change_name(const Settings& before, const Settings& after) {
  std::vector<std::string> names;
  for (std::size_t pane = 0; pane < kPaneCount; ++pane) pane_changes(before, after, pane, names);
  if (before.rays != after.rays) names.push_back(rays_change(before.rays, after.rays));
  if (before.overlay != after.overlay) {
    names.push_back(overlay_change(before.overlay, after.overlay));
  }
  if (before.heatmap != after.heatmap) {
    names.push_back(heatmap_change(before.heatmap, after.heatmap));
  }
  if (!same_animation(before.animation, after.animation)) names.emplace_back("animation");
  if (before.measure != after.measure) names.emplace_back("measuring");
  if (before.energy != after.energy) names.push_back(energy_change(before.energy, after.energy));
  if (names.empty()) return {};
  return names.size() == 1 ? names.front() : "several settings";
}

void History::observe(const Settings& now, bool busy) {
  if (!last_) last_ = now;
  if (busy) return;
  std::string name = change_name(*last_, now);
  if (name.empty()) return;
  steps_.resize(done_);
  steps_.push_back({*last_, now, std::move(name)});
  if (steps_.size() > most_) steps_.pop_front();
  done_ = steps_.size();
  last_ = now;
}

std::optional<Settings> History::undo(const Settings& now) {
  observe(now, false);
  if (!can_undo()) return std::nullopt;
  Settings settings = steps_[--done_].before;
  settings.animation.playing = now.animation.playing;
  last_ = settings;
  return settings;
}

std::optional<Settings> History::redo(const Settings& now) {
  observe(now, false);
  if (!can_redo()) return std::nullopt;
  Settings settings = steps_[done_++].after;
  settings.animation.playing = now.animation.playing;
  last_ = settings;
  return settings;
}

std::string History::undo_name() const {
  return can_undo() ? steps_[done_ - 1].name : std::string();
}

std::string History::redo_name() const {
  return can_redo() ? steps_[done_].name : std::string();
}

}  // namespace encore::ui
