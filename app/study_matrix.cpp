#include "app/study_matrix.h"

#include "app/exit_code.h"
#include "renderer/gl/error.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <string_view>
#include <utility>

namespace encore::app {

namespace {

/// Scenes by their name, each loaded once.
class SceneCache {
 public:
  SceneCache(const CommonOptions& options, Terminal& terminal)
      : options_(options), terminal_(terminal) {}

  std::shared_ptr<const scene::Scene> operator()(const std::string& name) {
    auto& scene = scenes_[name];
    if (!scene) {
      scene = std::make_shared<const scene::Scene>(open_scene(name, options_, terminal_));
    }
    return scene;
  }

 private:
  const CommonOptions& options_;
  Terminal& terminal_;
  std::map<std::string, std::shared_ptr<const scene::Scene>> scenes_;
};

bool renders(const std::string& test) {
  return test != "build";
}

/// The tests of one group with one combination of what ProfileOptions holds one of.
ProfileOptions options_of(const StudyGroup& group, const Study& study, const std::string& test) {
  ProfileOptions options;
  options.quiet = true;
  options.scenes = group.scenes;
  options.search_path = study.search_path;
  options.devices = group.devices;
  options.structures = group.structures;
  options.policies = group.policies;
  options.tests = {test};
  options.settings = group.settings;
  options.threads = group.threads;
  options.intersections = group.intersections;
  options.presets = group.presets;
  options.groupings = group.groupings;
  options.build_on = group.build_on;
  options.depth = group.depth;
  return options;
}

/// What of a group's lists a test goes through one by one: a build has no picture, so there it is
/// one combination whatever the lists hold.
std::vector<ProfileOptions> spread(const StudyGroup& group, const Study& study,
                                   const std::string& test) {
  const std::vector<std::string> no_size{"256"};
  const std::vector<std::string> no_rays{""};
  const bool pictures = renders(test);
  std::vector<ProfileOptions> all;
  ProfileOptions options = options_of(group, study, test);
  for (const std::string& size : pictures ? group.sizes : no_size) {
    options.size = size;
    for (const std::string& rays : pictures ? group.rays : no_rays) {
      options.rays = rays;
      for (const std::string& samples : pictures ? group.samples : no_rays) {
        options.samples = samples;
        for (const std::string& memory : group.memory) {
          options.memory = memory;
          for (const std::string& update_case : group.update_cases) {
            options.update_case = update_case;
            all.push_back(options);
          }
        }
      }
    }
  }
  return all;
}

/// For a table's cell: line breaks and what they indent become single blanks.
std::string in_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool blank = c == '\n' || c == ' ';
    if (blank && (line.empty() || line.back() == ' ')) continue;
    line += blank ? ' ' : c;
  }
  return line;
}

/// Whether there is OpenGL, asked when first needed.
class GpuQuestion {
 public:
  explicit GpuQuestion(const WorkloadTools& tools) : tools_(tools) {}

  bool usable() {
    if (!gpu_ && problem_.empty()) {
      try {
        gpu_ = tools_.open_gpu();
      } catch (const renderer::gl::GlUnavailable& error) {
        problem_ = in_one_line(error.what());
      }
    }
    return gpu_.has_value();
  }
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] const std::optional<GpuInfo>& info() const { return gpu_; }

 private:
  const WorkloadTools& tools_;
  std::optional<GpuInfo> gpu_;
  std::string problem_;
};

/// Adds the tests of a group, but for those of devices that are not there.
void take(StudyMatrix& matrix, GpuQuestion& gpu, const StudyGroup& group,
          std::vector<WorkloadSpec> specs) {
  std::size_t without = 0;
  for (WorkloadSpec& spec : specs) {
    if (uses_opengl(spec.device) && !gpu.usable()) {
      ++without;
    } else {
      matrix.tests.push_back(std::move(spec));
    }
  }
  if (without > 0) matrix.left_out.push_back({group.name, without, gpu.problem()});
}

}  // namespace

std::size_t StudyMatrix::described() const {
  std::size_t sum = tests.size();
  for (const LeftOut& left : left_out) sum += left.tests;
  return sum;
}

StudyMatrix spell_out(const Study& study, const WorkloadTools& tools, Terminal& terminal) {
  CommonOptions common;
  common.search_path = study.search_path;
  SceneCache cache(common, terminal);
  const SceneOpener open = [&](const std::string& name) { return cache(name); };

  StudyMatrix matrix;
  GpuQuestion gpu(tools);
  for (const StudyGroup& group : study.groups) {
    std::vector<WorkloadSpec> specs;
    const std::vector<std::string> all{"build", "static", "dynamic"};
    for (const std::string& test : group.tests.empty() ? all : group.tests) {
      for (const ProfileOptions& options : spread(group, study, test)) {
        try {
          for (WorkloadSpec& spec : list_workloads(options, tools, terminal, open)) {
            spec.group = group.name;
            specs.push_back(std::move(spec));
          }
        } catch (const scene::InputError& error) {
          throw scene::InputError(
              fmt::format("{}: group {}: {}", group.place, group.name, error.what()));
        } catch (const UsageError& error) {
          // What a test cannot be applied to is told, and the rest goes on.
          matrix.left_out.push_back({group.name, 0, error.what()});
        }
      }
    }
    take(matrix, gpu, group, std::move(specs));
  }
  matrix.gpu = gpu.info();
  return matrix;
}

}  // namespace encore::app
