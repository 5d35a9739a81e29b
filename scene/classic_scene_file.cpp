#include "scene/classic_scene_file.h"

#include "scene/assets.h"
#include "scene/basic_shapes.h"
#include "scene/load_watch.h"
#include "scene/placement.h"
#include "scene/rotation.h"
#include "scene/text_suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace encore::scene {
namespace {

constexpr std::string_view kCommands[] = {"CAMERA",     "BACKGROUND_COLOR", "LIGHT",  "POINT_LIGHT",
                                          "RECT_LIGHT", "MATERIAL",         "SPHERE", "MODEL",
                                          "DYNAMIC"};
/// A text that is no scene at all would give a warning a line.
constexpr int kMaxUnknownCommands = 20;
/// The original names no frame rate; this is FrameSequence's own.
constexpr float kFramesPerSecond = 10.0F;

/// One command line, split into words; the first is the command.
struct Line {
  std::string place;  ///< file:line
  std::vector<std::string_view> words;

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(fmt::format("{}: {}: {}", place, words.front(), message));
  }
};

/// Splits at spaces. A `*` starts a comment, wherever it stands.
Line split(std::string_view text, std::string place) {
  Line line{std::move(place), {}};
  text = text.substr(0, text.find('*'));
  constexpr std::string_view kSpaces = " \t\r\v\f";
  for (std::size_t i = text.find_first_not_of(kSpaces); i != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSpaces, i), text.size());
    line.words.push_back(text.substr(i, end - i));
    i = text.find_first_not_of(kSpaces, end);
  }
  return line;
}

double parse_number(const Line& line, std::string_view word) {
  // from_chars does not depend on the locale; unlike C it refuses a leading plus.
  std::string_view digits = word;
  if (digits.size() > 1 && digits.front() == '+') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) {
    line.fail(fmt::format("'{}' is not a number", word));
  }
  if (error != std::errc() || !std::isfinite(value) || std::fabs(value) > 1e37) {
    line.fail(fmt::format("'{}' is not a finite number of at most 1e37", word));
  }
  return value;
}

class ClassicScene {
 public:
  ClassicScene(const std::string& file_name, const std::filesystem::path& folder,
               const std::vector<std::filesystem::path>& search_path);
  Scene parse(std::string_view text);

 private:
  void command(const Line& line);
  void unknown(const Line& line);
  void camera(const Line& line);
  void background(const Line& line);
  void point_light(const Line& line);
  void rect_light(const Line& line);
  void material(const Line& line);
  void sphere(const Line& line);
  void model(const Line& line);
  void dynamic(const Line& line);
  void place_rect_light();

  /// The numbers behind `skip` words. Fewer than `least` are an error, more than `most` a warning.
  std::vector<float> numbers(const Line& line, std::size_t skip, std::size_t least,
                             std::size_t most);
  void warn(const Line& line, const std::string& message);
  [[nodiscard]] const Material* current() const { return material_ ? &*material_ : nullptr; }

  Scene scene_;
  Assets assets_;
  std::optional<Material> material_;  ///< of the models that follow
  std::optional<glm::vec3> rect_light_;
  std::shared_ptr<const Model> sphere_;
  int known_ = 0;
  int unknown_ = 0;
};

glm::vec3 vec(const std::vector<float>& n, std::size_t at) {
  return {n[at], n[at + 1], n[at + 2]};
}

/// position, rotation by an angle around an axis.
Transform pose(const std::vector<float>& n, std::size_t position, std::size_t angle) {
  Transform t;
  t.translation = vec(n, position);
  t.rotation_degrees = n[angle];
  t.rotation_axis = vec(n, angle + 1);
  return t;
}

ClassicScene::ClassicScene(const std::string& file_name, const std::filesystem::path& folder,
                           const std::vector<std::filesystem::path>& search_path)
    : assets_(folder, search_path) {
  scene_.source = file_name;
  scene_.name = std::filesystem::path(file_name).stem().string();
}

void ClassicScene::warn(const Line& line, const std::string& message) {
  scene_.warnings.add(fmt::format("{}: {}: {}", line.place, line.words.front(), message));
}

std::vector<float> ClassicScene::numbers(const Line& line, std::size_t skip, std::size_t least,
                                         std::size_t most) {
  const std::size_t count = line.words.size() - std::min(skip, line.words.size());
  if (count < least) line.fail(fmt::format("needs {} numbers, has {}", least, count));
  if (count > most) warn(line, fmt::format("{} numbers; those after {} are ignored", count, most));
  std::vector<float> result;
  for (std::size_t i = 0; i < std::min(count, most); ++i) {
    result.push_back(static_cast<float>(parse_number(line, line.words[skip + i])));
  }
  return result;
}

void ClassicScene::camera(const Line& line) {
  const auto n = numbers(line, 1, 10, 13);
  Camera camera{vec(n, 0), vec(n, 3), vec(n, 6), n[9]};
  if (!(n[9] > 0.0F && n[9] < 180.0F)) {
    line.fail(
        fmt::format("the field of view must be greater than 0 and less than 180, not {}", n[9]));
  }
  const glm::dvec3 view = unit_or_zero(camera.target - camera.eye);
  const glm::dvec3 up = unit_or_zero(camera.up);
  if (view == glm::dvec3(0.0)) line.fail("eye and look-at point must differ");
  const double along = view.x * up.x + view.y * up.y + view.z * up.z;
  if (up == glm::dvec3(0.0) || along * along > 1.0 - 1e-12) {
    // One of the original's own scenes looks along z with up = z.
    camera.up = std::fabs(view.y) < 0.9 ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(0.0F, 0.0F, 1.0F);
    warn(line, fmt::format("up lies along the view; ({}, {}, {}) is used", camera.up.x, camera.up.y,
                           camera.up.z));
  }
  if (n.size() > 10 && n[10] != 1.0F) {
    warn(line, "the aspect ratio is ignored: it is that of the image");
  }
  if (n.size() > 11) warn(line, "near and far plane are ignored: rays have none");
  scene_.camera = camera;
}

void ClassicScene::background(const Line& line) {
  const auto n = numbers(line, 1, 3, 4);
  if (n.size() > 3 && n[3] != 1.0F) warn(line, "the background's alpha is ignored");
  scene_.background = vec(n, 0);
}

void ClassicScene::point_light(const Line& line) {
  const auto n = numbers(line, 1, 6, 6);
  scene_.lights.push_back(Light{vec(n, 0), vec(n, 3)});
}

void ClassicScene::rect_light(const Line& line) {
  const auto n = numbers(line, 1, 3, 3);
  if (rect_light_) warn(line, "replaces the RECT_LIGHT before it");
  rect_light_ = vec(n, 0);
  warn(line,
       "area lights have no counterpart: a point light below the middle of the scene's top "
       "stands for it");
}

/// Where a ceiling lamp would hang: below the middle of the top, by 2 % of the scene's height.
void ClassicScene::place_rect_light() {
  if (!rect_light_) return;
  const Bounds bounds = bounds_at_start(scene_);
  if (bounds.empty()) return;
  glm::vec3 position = bounds.center();
  position.y = bounds.max.y - 0.02F * bounds.size().y;
  scene_.lights.push_back(Light{position, *rect_light_});
}

void ClassicScene::material(const Line& line) {
  const auto n = numbers(line, 1, 3, 13);
  if (n.size() < 13) {
    warn(line, fmt::format("{} numbers instead of 13; the missing ones are 0", n.size()));
  }
  std::vector<float> v = n;
  v.resize(13, 0.0F);
  const auto share = [](float x) { return std::clamp(x, 0.0F, 1.0F); };
  Material m;
  m.name = fmt::format("line {}", line.place.substr(line.place.rfind(':') + 1));
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    m.diffuse[i] = share(v[at]);
    m.specular[i] = share(v[3 + at]);
    m.ambient[i] = share(v[6 + at]);
  }
  m.reflectivity = share(v[9]);
  m.opacity = 1.0F - share(v[10]);
  if (v[11] > 0.0F) m.index_of_refraction = v[11];
  if (v[12] != 0.0F) warn(line, "transmittance has no counterpart and is ignored");
  if (std::any_of(v.begin(), v.begin() + 11, [&](float x) { return x != share(x); })) {
    warn(line, "values outside 0 to 1 were clamped");
  }
  material_ = m;
}

void ClassicScene::sphere(const Line& line) {
  // x y z radius scale angle axis; the sphere is tessellated.
  const auto n = numbers(line, 1, 4, 9);
  std::vector<float> v = n;
  if (v.size() < 5) v.push_back(1.0F);
  v.resize(9, 0.0F);
  if (!sphere_) sphere_ = std::make_shared<const Model>(sphere_model());
  Transform t = pose(v, 0, 5);
  t.scale = glm::vec3(v[3] * v[4]);
  if (!(t.scale.x > 0.0F)) line.fail("radius times scale must be greater than 0");
  Instance instance;
  instance.name = fmt::format("sphere {}", line.place.substr(line.place.rfind(':') + 1));
  instance.model = sphere_;
  instance.transform = t.matrix();
  assets_.add(scene_, std::move(instance), current(), line.place);
}

void ClassicScene::model(const Line& line) {
  if (line.words.size() < 2) line.fail("needs a file");
  const auto n = numbers(line, 2, 8, 8);
  if (!(n[3] > 0.0F)) line.fail(fmt::format("the size must be greater than 0, not {}", n[3]));
  const std::string file(line.words[1]);
  Instance instance;
  instance.model = assets_.model(file, line.place, scene_.warnings);
  instance.name = std::filesystem::path(file).stem().string();
  // Centred, the longest side scaled to the size, then turned and moved.
  instance.transform = pose(n, 0, 4).matrix() *
                       fit_matrix(bounds_under(instance.model->mesh, glm::mat4(1.0F)), n[3]);
  assets_.add(scene_, std::move(instance), current(), line.place);
}

void ClassicScene::dynamic(const Line& line) {
  if (line.words.size() < 2) line.fail("needs a folder");
  // step x y z scale angle axis: every step-th frame, all at one scale.
  const auto n = numbers(line, 2, 9, 9);
  if (!(n[0] >= 1.0F && n[0] <= 1e6F) || n[0] != std::floor(n[0])) {
    line.fail(fmt::format("the frame step must be a whole number from 1 on, not {}", n[0]));
  }
  if (!(n[4] > 0.0F)) line.fail(fmt::format("the scale must be greater than 0, not {}", n[4]));
  const std::string folder(line.words[1]);
  const auto files = assets_.frames_of_folder(folder, line.place);
  if (files.size() > kMaxFrames) {
    line.fail(fmt::format("{} frames; the limit is {}", files.size(), kMaxFrames));
  }
  FrameSequence sequence;
  sequence.frames_per_second = kFramesPerSecond;
  for (std::size_t i = 0; i < files.size(); i += static_cast<std::size_t>(n[0])) {
    const FramePart part(i, files.size());
    sequence.frames.push_back(assets_.model(files[i], line.place, scene_.warnings));
  }
  Transform t = pose(n, 1, 5);
  t.scale = glm::vec3(n[4]);
  Instance instance;
  instance.name = std::filesystem::path(folder).filename().string();
  instance.model = sequence.frames.front();
  instance.transform = t.matrix();
  instance.motion = std::move(sequence);
  assets_.add(scene_, std::move(instance), current(), line.place);
}

void ClassicScene::unknown(const Line& line) {
  ++unknown_;
  const std::string_view word = line.words.front();
  if (unknown_ > kMaxUnknownCommands) return;
  scene_.warnings.add(fmt::format("{}: unknown command '{}' is ignored{}", line.place,
                                  word.substr(0, 64), did_you_mean(word, kCommands)));
}

void ClassicScene::command(const Line& line) {
  const std::string_view word = line.words.front();
  ++known_;
  if (word == "CAMERA") return camera(line);
  if (word == "BACKGROUND_COLOR") return background(line);
  if (word == "LIGHT" || word == "POINT_LIGHT") return point_light(line);
  if (word == "RECT_LIGHT") return rect_light(line);
  if (word == "MATERIAL") return material(line);
  if (word == "SPHERE") return sphere(line);
  if (word == "MODEL") return model(line);
  if (word == "DYNAMIC") return dynamic(line);
  --known_;
  unknown(line);
}

Scene ClassicScene::parse(std::string_view text) {
  // A byte order mark is no part of the first command.
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  std::size_t number = 0;
  // Models are spread over the file, so its bytes stand for the work.
  const auto size = static_cast<double>(text.size());
  const auto begin_of = [size](std::string_view rest) {
    return 1.0 - static_cast<double>(rest.size()) / size;
  };
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::size_t next = end == std::string_view::npos ? text.size() : end + 1;
    const LoadPart part(begin_of(text), begin_of(text.substr(next)));
    if (number % 1024 == 0) check_load();
    const Line line = split(text.substr(0, end), fmt::format("{}:{}", scene_.source, ++number));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    if (!line.words.empty()) command(line);
  }
  if (known_ == 0 && unknown_ > 0) {
    throw InputError(fmt::format("{}: no line is a command of a scene file (those are {})",
                                 scene_.source, fmt::join(kCommands, ", ")));
  }
  if (unknown_ > kMaxUnknownCommands) {
    scene_.warnings.add(fmt::format("{}: {} more unknown commands are ignored", scene_.source,
                                    unknown_ - kMaxUnknownCommands));
  }
  place_rect_light();
  add_default_light(scene_);
  return std::move(scene_);
}

}  // namespace

Scene parse_classic_scene(std::string_view text, const std::string& file_name,
                          const std::filesystem::path& folder,
                          const std::vector<std::filesystem::path>& search_path) {
  return ClassicScene(file_name, folder, search_path).parse(text);
}

}  // namespace encore::scene
