// A plain scene's shader holds nothing of what the scene does not use, and its device nothing but
// triangles, structure, materials and lights.
#include "renderer/gl/shader_source.h"
#include "renderer/trace_defines.h"
#include "scene/left_out.h"
#include "tests/gpu/gpu_scenes.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

namespace encore::renderer::test {
namespace {

using accel::StructureKind;

/// The lines of GLSL that its conditions leave, without comments. Macros stay as they are, their
/// definitions go. Knows the conditions that shaders/ uses: defined(), !, && and ||.
class Preprocessed {
 public:
  explicit Preprocessed(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      while (line.ends_with('\\')) {
        std::string next;
        if (!std::getline(lines, next)) break;
        line = line.substr(0, line.size() - 1) + next;
      }
      add(line.substr(0, line.find("//")));
    }
    EXPECT_TRUE(open_.empty()) << "a condition is not ended";
  }
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Whether an identifier occurs; of structs only what is used counts.
  [[nodiscard]] bool has(const std::string& identifier) const {
    return std::regex_search(code_, std::regex("\\b" + identifier + "\\b"));
  }

 private:
  struct Condition {
    bool holds = false;
    bool held_before = false;  ///< in an earlier branch
  };

  [[nodiscard]] bool active() const {
    for (const Condition& one : open_) {
      if (!one.holds) return false;
    }
    return true;
  }

  [[nodiscard]] bool holds(const std::string& expression) const {
    const std::size_t either = expression.find("||");
    if (either != std::string::npos) {
      return holds(expression.substr(0, either)) || holds(expression.substr(either + 2));
    }
    const std::size_t both = expression.find("&&");
    if (both != std::string::npos) {
      return holds(expression.substr(0, both)) && holds(expression.substr(both + 2));
    }
    std::smatch found;
    if (!std::regex_match(expression, found, std::regex(R"(\s*(!?)defined\((\w+)\)\s*)"))) {
      ADD_FAILURE() << "a condition of another form: " << expression;
      return false;
    }
    return defined_.contains(found[2]) == (found[1].length() == 0);
  }

  void add(const std::string& line) {
    std::istringstream words(line);
    std::string directive;
    words >> directive;
    std::string rest;
    std::getline(words, rest);
    const std::string name = rest.substr(std::min(rest.size(), rest.find_first_not_of(' ')));
    if (directive == "#ifdef") return open(defined_.contains(word(name)));
    if (directive == "#ifndef") return open(!defined_.contains(word(name)));
    if (directive == "#if") return open(holds(rest));
    if (directive == "#elif") return next(holds(rest));
    if (directive == "#else") return next(true);
    if (directive == "#endif") return open_.pop_back();
    if (!active()) return;
    if (directive == "#define") {
      defined_.insert(word(name));
    } else if (!directive.starts_with('#')) {
      append(line);
    }
  }

  static std::string word(const std::string& text) {
    return text.substr(0, text.find_first_of(" (\t"));
  }
  void open(bool holds) { open_.push_back({holds, holds}); }
  void next(bool holds) {
    Condition& last = open_.back();
    last.holds = holds && !last.held_before;
    last.held_before = last.held_before || holds;
  }

  void append(const std::string& line) {
    text_ += line + '\n';
    if (line.starts_with("struct ")) in_struct_ = true;
    if (!in_struct_) code_ += line + '\n';
    if (line.starts_with("};")) in_struct_ = false;
  }

  std::set<std::string> defined_;
  std::vector<Condition> open_;
  std::string text_;
  std::string code_;  ///< without the members of structs
  bool in_struct_ = false;
};

Preprocessed picture_shader(StructureKind kind, const ShadingNeeds& needs,
                            TraceOutput output = TraceOutput::picture) {
  const TraceVariant variant{
      .kind = kind, .depth = 5, .output = output, .needs = needs, .lights = true};
  return Preprocessed(gl::assemble_shader("trace.comp", trace_defines(variant)).text);
}

/// What gives a feature away.
struct Feature {
  const char* name;
  std::vector<std::string> identifiers;
  ShadingNeeds needs{};
  TraceOutput output = TraceOutput::picture;
};

std::vector<Feature> features() {
  return {
      {.name = "normals", .identifiers = {"corner_normals"}, .needs = {.normals = true}},
      {.name = "colours", .identifiers = {"corner_colors"}, .needs = {.colors = true}},
      {.name = "textures",
       .identifiers = {"corner_texcoords", "textures", "texture", "texel", "texture_color"},
       .needs = {.textures = true}},
      {.name = "highlights",
       .identifiers = {"specular", "shininess", "pow", "mirrored"},
       .needs = {.specular = true}},
      {.name = "paths",
       .identifiers = {"paths", "path_queues", "queue_first"},
       .output = TraceOutput::path_hits},
      {.name = "shadows",
       .identifiers = {"shadow_rays", "ENCORE_QUEUE_SHADOWS"},
       .output = TraceOutput::shadows},
      {.name = "counters",
       .identifiers = {"counted_steps", "counted_box_tests", "ray_counters"},
       .output = TraceOutput::counters},
      {.name = "rays from a buffer",
       .identifiers = {"rays", "ray_count"},
       .output = TraceOutput::ray_hits},
  };
}

class PlainShader : public testing::TestWithParam<StructureKind> {};

TEST_P(PlainShader, HasNothingOfWhatAPlainSceneDoesNotUse) {
  const Preprocessed plain = picture_shader(GetParam(), {});
  EXPECT_TRUE(plain.has("lights") && plain.has("diffuse") && plain.has("camera_ray"));
  for (const Feature& feature : features()) {
    for (const std::string& identifier : feature.identifiers) {
      EXPECT_FALSE(plain.has(identifier)) << feature.name << ": " << identifier;
      // The names are right: with the feature they are there.
      EXPECT_TRUE(picture_shader(GetParam(), feature.needs, feature.output).has(identifier))
          << feature.name << ": " << identifier;
    }
  }
  for (const char* other : {"sample_offset", "scatter", "waiting_rays", "ENCORE_BINDING_BOUNCES"}) {
    EXPECT_FALSE(plain.has(other)) << other;
  }
}

TEST_P(PlainShader, EachFeatureOnlyAdds) {
  const std::size_t plain = picture_shader(GetParam(), {}).text().size();
  for (const Feature& feature : features()) {
    if (feature.output != TraceOutput::picture) continue;
    EXPECT_GT(picture_shader(GetParam(), feature.needs).text().size(), plain) << feature.name;
  }
}

class PlainUpload : public encore::test::GlTest,
                    public testing::WithParamInterface<StructureKind> {};

std::uint64_t structure_bytes(const GpuTestScene& setup) {
  std::uint64_t sum = 0;
  for (const accel::GpuBuffer& part : setup.structure->gpu_buffers()) sum += part.bytes.size();
  return sum;
}

TEST_P(PlainUpload, IsTrianglesStructureMaterialsAndLights) {
  const auto setup = sample_scene("mug", spec_of(GetParam()));
  for (scene::Material& material : setup->scene.materials) material.specular = glm::vec3(0.0F);
  setup->list.normals.clear();
  setup->list.colors.clear();
  setup->list.texcoords.clear();
  GpuTracer tracer(context_);
  tracer.init(setup->input());
  const std::uint64_t plain = setup->list.triangles.size() * sizeof(gpu::Triangle) +
                              structure_bytes(*setup) +
                              (setup->scene.materials.size() + 1) * sizeof(gpu::Material) +
                              setup->scene.lights.size() * sizeof(gpu::Light);
  EXPECT_EQ(tracer.last_transfer().uploaded_bytes, plain);
  const scene::Needs needs = scene::needs_of(setup->scene, setup->list, {});
  EXPECT_EQ(scene::device_bytes(setup->scene, setup->list, needs) + structure_bytes(*setup), plain);
}

TEST_P(PlainUpload, OfEverySceneIsWhatIsToldOfIt) {
  for (const char* name : {"cow", "toys", "mirrors"}) {
    for (const bool everything : {false, true}) {
      const auto setup = sample_scene(name, spec_of(GetParam()));
      const scene::RaySettings rays = everything ? scene::every_ray() : scene::RaySettings{};
      GpuTracer tracer(context_);
      tracer.set_rays(rays);
      tracer.init(setup->input());
      const scene::Needs needs = scene::needs_of(setup->scene, setup->list, rays);
      EXPECT_EQ(tracer.last_transfer().uploaded_bytes,
                scene::device_bytes(setup->scene, setup->list, needs) + structure_bytes(*setup))
          << name << (everything ? ", every kind of ray" : "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PlainShader, testing::ValuesIn(gpu_kinds()), kind_name);
INSTANTIATE_TEST_SUITE_P(Kinds, PlainUpload,
                         testing::Values(StructureKind::bvh_median, StructureKind::grid_exact),
                         kind_name);

}  // namespace
}  // namespace encore::renderer::test
