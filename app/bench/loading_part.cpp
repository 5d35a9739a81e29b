#include "accel/make_structure.h"
#include "app/bench/bench.h"
#include "app/bench/loading_files.h"
#include "renderer/cpu_tracer.h"
#include "scene/mesh_reader.h"
#include "scene/obj_library.h"
#include "scene/scene_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <optional>

namespace encore::app::bench {

namespace {

namespace fs = std::filesystem;

/// A folder that goes when this does.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "encore-bench-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw std::runtime_error("cannot make a folder in " + fs::temp_directory_path().string());
    }
    path_ = pattern;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A file, and who else reads it.
struct LoadCase {
  fs::path path;
  std::string peer;  ///< empty: nobody
  std::function<std::size_t(const fs::path&)> parse{};
};

std::vector<LoadCase> own_files(Bench& bench, const fs::path& folder) {
  bench.progress("writing files to read");
  const BenchScene scene = load_bench_scene(bench.plan.loading_scene);
  const scene::Mesh mesh = indexed_mesh(scene.triangles);
  std::vector<LoadCase> cases = {
      {folder / "binary.ply", "read and copy", parse_binary_ply},
      {folder / "ascii.ply", "from_chars", parse_ascii_ply},
      {folder / "plain.obj", "tinyobjloader", scene::count_obj_triangles}};
  write_binary_ply(cases[0].path, mesh);
  write_ascii_ply(cases[1].path, mesh);
  write_obj(cases[2].path, mesh);
  return cases;
}

/// Everything up to the picture, on one thread; says after each part what it was.
template <class Note>
void show(const fs::path& path, int side, const Note& note) {
  const scene::Scene scene = scene::load_scene(path.string());
  note("read");
  scene::TriangleList list;
  scene::update_triangles(scene, 0.0, list);
  note("list");
  const auto structure = accel::make_structure(accel::default_spec(accel::StructureKind::bvh_sah));
  structure->set_build_threads(1);
  structure->build(list.triangles);
  note("build");
  renderer::CpuTracer tracer(1);
  tracer.init({&scene, &list, structure.get()});
  tracer.draw(scene.camera, side, side);
  note("trace");
}

/// "read 120, list 8, build 95, trace 40 ms", of one run.
std::string split_of_showing(const fs::path& path, int side) {
  std::string text;
  double last = processor_s();
  show(path, side, [&](const char* part) {
    const double now = processor_s();
    text += fmt::format("{}{} {:.0f}", text.empty() ? "" : ", ", part, 1e3 * (now - last));
    last = now;
  });
  return text + " ms";
}

void race_case(Bench& bench, const LoadCase& one) {
  bench.progress("loading " + one.path.filename().string());
  std::size_t triangles = 0;
  std::vector<Runner> runners;
  if (one.parse) {
    runners.push_back({one.peer, [&] { triangles = one.parse(one.path); }});
  }
  const std::size_t first = runners.size();
  runners.push_back(
      {"reader", [&] { triangles = scene::read_model(one.path).mesh.triangles.size(); }});
  runners.push_back(
      {"to the first picture", [&] { show(one.path, bench.plan.side, [](const char*) {}); }});
  const RaceTimes times = race(runners, bench.race_settings(1));
  if (times.front().empty()) return;
  const auto bytes = static_cast<double>(fs::file_size(one.path));
  for (std::size_t k = first; k < runners.size(); ++k) {
    BenchRow frame{.part = "loading",
                   .scene = one.path.filename().string(),
                   .triangles = triangles,
                   .threads = 1,
                   .operation = "read",
                   .ours = runners[k].name,
                   .peer = one.peer,
                   .unit = "MB/s"};
    frame.note = fmt::format("{:.0f} ms", 1e3 * spread_of(times[k]).median);
    if (first > 0) frame.note += fmt::format(", peer {:.0f} ms", 1e3 * spread_of(times[0]).median);
    if (k > first) frame.note += "; " + split_of_showing(one.path, bench.plan.side);
    bench.report.add(rate_row(frame, bytes, times[k], bytes, first > 0 ? &times[0] : nullptr));
  }
}

}  // namespace

void bench_loading(Bench& bench) {
  if (bench.cancelled()) return;
  std::optional<ScratchFolder> folder;
  std::vector<LoadCase> cases;
  for (const std::string& file : bench.plan.loading) {
    LoadCase one{file, {}, {}};
    if (one.path.extension() == ".obj") {
      one.peer = "tinyobjloader";
      one.parse = scene::count_obj_triangles;
    }
    cases.push_back(std::move(one));
  }
  if (cases.empty()) cases = own_files(bench, folder.emplace().path());
  for (const LoadCase& one : cases) {
    if (bench.cancelled()) return;
    race_case(bench, one);
  }
}

}  // namespace encore::app::bench
