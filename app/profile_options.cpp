#include "app/profile_options.h"

#include "app/exit_code.h"
#include "app/ray_options.h"
#include "renderer/gl/error.h"
#include "scene/sample_scenes.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace encore::app {

namespace {

using accel::Policy;

constexpr TestKind kAllTests[] = {TestKind::build, TestKind::fixed, TestKind::animated,
                                  TestKind::forced};
/// Measured if none is named: a forced test adds nothing where the scene moves by itself.
constexpr TestKind kUsualTests[] = {TestKind::build, TestKind::fixed, TestKind::animated};

TestKind parse_test(const std::string& name) {
  std::vector<std::string_view> names;
  for (const TestKind test : kAllTests) {
    if (name == to_string(test)) return test;
    names.push_back(to_string(test));
  }
  throw UsageError(fmt::format("unknown test '{}'{}; there are {}", name,
                               scene::did_you_mean(name, names), fmt::join(names, ", ")));
}

std::string unknown_policy(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Policy policy : accel::all_policies()) names.push_back(accel::to_string(policy));
  return fmt::format("unknown policy '{}'{}; there are {}", name, scene::did_you_mean(name, names),
                     fmt::join(names, ", "));
}

/// The devices asked for, else the scene's, else the CPU; each once.
std::vector<Device> chosen_devices(const ProfileOptions& options, const scene::Scene& scene) {
  std::vector<Device> devices;
  for (const std::string& name : options.devices) {
    const auto device = parse_device(name);
    if (!device) throw UsageError(unknown_device(name));
    if (std::find(devices.begin(), devices.end(), *device) == devices.end()) {
      devices.push_back(*device);
    }
  }
  if (!devices.empty()) return devices;
  if (const scene::Preference* stated = preference(scene, "device")) {
    const auto device = parse_device(stated->value);
    if (!device) throw scene::InputError(stated->place + ": " + unknown_device(stated->value));
    return {*device};
  }
  return {Device::cpu};
}

/// The policies asked for, else the scene's, else rebuild; each once.
std::vector<Policy> chosen_policies(const ProfileOptions& options, const scene::Scene& scene) {
  std::vector<Policy> policies;
  for (const std::string& name : options.policies) {
    const auto policy = accel::parse_policy(name);
    if (!policy) throw UsageError(unknown_policy(name));
    if (std::find(policies.begin(), policies.end(), *policy) == policies.end()) {
      policies.push_back(*policy);
    }
  }
  if (!policies.empty()) return policies;
  if (const scene::Preference* stated = preference(scene, "policy")) {
    const auto policy = accel::parse_policy(stated->value);
    if (!policy) throw scene::InputError(stated->place + ": " + unknown_policy(stated->value));
    return {*policy};
  }
  return {Policy::rebuild};
}

accel::BuildPlace chosen_build_place(const std::string& name) {
  const auto place = accel::parse_build_place(name);
  if (!place) {
    throw UsageError(
        fmt::format("--build-on: unknown place '{}'; there are auto, cpu and device", name));
  }
  return *place;
}

void set_update_case(accel::StructureSpec& spec, const std::string& name) {
  if (name.empty()) return;
  const auto update_case = accel::parse_update_case(name);
  if (!update_case) {
    throw UsageError(
        fmt::format("unknown update case '{}'; there are real, best, average, worst", name));
  }
  if (auto* bvh = std::get_if<accel::BvhSettings>(&spec.settings)) bvh->update_case = *update_case;
}

/// Lists the tests of one scene. Those that measure nothing new are left out, such as refitting a
/// structure that can only be rebuilt when rebuilding is asked for as well.
class ScenePlan {
 public:
  ScenePlan(const ProfileOptions& options, const WorkloadTools& tools, Terminal& terminal,
            std::shared_ptr<const scene::Scene> scene)
      : options_(options), tools_(tools), terminal_(terminal), scene_(std::move(scene)) {
    for (const std::string& name : options.tests) tests_.push_back(parse_test(name));
    named_ = !tests_.empty();
    if (!named_) tests_.assign(std::begin(kUsualTests), std::end(kUsualTests));
    policies_ = chosen_policies(options, *scene_);
    devices_ = chosen_devices(options, *scene_);
    build_on_ = chosen_build_place(options.build_on);
  }

  void append_to(std::vector<WorkloadSpec>& all) {
    const std::vector<accel::StructureSpec> structures = chosen_structures(options_, *scene_);
    WorkloadSpec spec;
    spec.scene = scene_;
    spec.size = parse_size(options_.size);
    spec.threads = chosen_threads(options_, *scene_);
    spec.rays = chosen_rays(options_, *scene_);
    for (const Device device : devices_) {
      spec.device = device;
      if (!traces_rays(device)) {
        // Nothing to choose: no structure, and so no policy.
        spec.structure = {};
        append_tests(spec, {Policy::fixed}, all);
        continue;
      }
      for (const accel::StructureSpec& structure : structures) {
        spec.structure = structure;
        set_update_case(spec.structure, options_.update_case);
        const bool can_refit = tools_.make_structure(spec.structure)->can_refit();
        append_tests(spec, distinct_policies(can_refit), all);
      }
    }
  }

  /// Why tests were left out, each reason once.
  [[nodiscard]] const std::vector<std::string>& reasons() const { return reasons_; }

 private:
  void append_tests(WorkloadSpec spec, const std::vector<Policy>& policies,
                    std::vector<WorkloadSpec>& all) {
    for (const TestKind test : tests_) {
      spec.test = test;
      const bool still = test == TestKind::fixed;
      for (const Policy policy : still ? std::vector{Policy::fixed} : policies) {
        spec.policy = policy;
        std::string reason = place_build(spec);
        if (reason.empty()) reason = reason_to_skip(spec);
        if (reason.empty()) {
          all.push_back(spec);
        } else {
          leave_out(spec, reason);
        }
      }
    }
  }

  /// Settles where the structure is built; why it cannot be built where it was asked for, if so.
  std::string place_build(WorkloadSpec& spec) {
    spec.build_on = accel::BuildPlace::cpu;
    if (spec.device != Device::gpu || spec.test == TestKind::fixed) return {};
    const bool possible = accel::device_can_build(spec.structure, spec.policy);
    if (build_on_ == accel::BuildPlace::device && !possible) {
      return fmt::format(
          "{} under policy {} cannot be built on the device; choose --structure bvh-sah --preset "
          "fast --policy rebuild, or --build-on cpu",
          accel::to_string(spec.structure.kind), accel::to_string(spec.policy));
    }
    const bool asks = possible && build_on_ == accel::BuildPlace::automatic;
    spec.build_on = accel::place_of_build(build_on_, spec.structure, spec.policy,
                                          !asks || device_is_software());
    return {};
  }

  /// As if in software where there is none: that is told when it is used.
  bool device_is_software() {
    if (!software_) {
      try {
        software_ = !tools_.open_gpu || tools_.open_gpu().software;
      } catch (const renderer::gl::GlUnavailable&) {
        software_ = true;
      }
    }
    return *software_;
  }

  /// Says once a scene why something is left out that was asked for by name.
  void leave_out(const WorkloadSpec& spec, const std::string& reason) {
    if (std::find(reasons_.begin(), reasons_.end(), reason) != reasons_.end()) return;
    reasons_.push_back(reason);
    const bool named_structure = spec.structure.kind == accel::StructureKind::brute ||
                                 build_on_ == accel::BuildPlace::device;
    if (named_ || named_structure) terminal_.warning(reason);
  }

  [[nodiscard]] std::vector<Policy> distinct_policies(bool can_refit) const {
    std::vector<Policy> distinct;
    for (Policy policy : policies_) {
      const bool refits = policy == Policy::refit || policy == Policy::automatic;
      if (refits && !can_refit) policy = Policy::rebuild;
      if (std::find(distinct.begin(), distinct.end(), policy) == distinct.end()) {
        distinct.push_back(policy);
      }
    }
    return distinct;
  }

  const ProfileOptions& options_;
  const WorkloadTools& tools_;
  Terminal& terminal_;
  std::shared_ptr<const scene::Scene> scene_;
  std::vector<TestKind> tests_;
  bool named_ = false;
  std::vector<Policy> policies_;
  std::vector<Device> devices_;
  std::vector<std::string> reasons_;
  accel::BuildPlace build_on_ = accel::BuildPlace::automatic;
  std::optional<bool> software_;
};

}  // namespace

std::vector<WorkloadSpec> list_workloads(const ProfileOptions& options, const WorkloadTools& tools,
                                         Terminal& terminal) {
  return list_workloads(options, tools, terminal, [&](const std::string& name) {
    return std::make_shared<const scene::Scene>(open_scene(name, options, terminal));
  });
}

std::vector<WorkloadSpec> list_workloads(const ProfileOptions& options, const WorkloadTools& tools,
                                         Terminal& terminal, const SceneOpener& open) {
  std::vector<std::string> names = options.scenes;
  if (names.empty()) names.emplace_back(scene::kDefaultSceneName);
  std::vector<WorkloadSpec> all;
  std::string why;
  for (const std::string& name : names) {
    ScenePlan plan(options, tools, terminal, open(name));
    plan.append_to(all);
    if (why.empty() && !plan.reasons().empty()) why = plan.reasons().front();
  }
  if (all.empty()) {
    throw UsageError(
        "nothing to measure: none of the tests applies to the scenes, devices and policies asked "
        "for (" +
        why + ")");
  }
  return all;
}

}  // namespace encore::app
