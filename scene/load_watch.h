#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string>

namespace encore::scene {

/// How another thread follows the loading of a scene and ends it: see LoadScope.
class LoadWatch {
 public:
  const std::atomic<bool>* cancel = nullptr;  ///< true: end the loading; null: it cannot be ended
  /// Share of the work that is done: 0 at the start, never less than before, 1 when it has ended
  /// well. An estimate: files by the bytes gone through, sequences by frames, scene files by
  /// models, each taken for as long as the others. What Assimp reads is not seen until it is there.
  std::atomic<float> progress{0.0F};
  /// What is being read: "frame 3 of 120, walk-003.ply". Empty before the start.
  [[nodiscard]] std::string doing() const;

  // What tests are made of, so that they need no clock; see accel::BuildWatch.
  std::uint64_t looks = 0;
  std::uint64_t last_look = ~std::uint64_t{0};

 private:
  friend class LoadScope;
  friend class LoadPart;
  friend void note_load(const std::string& what);
  void set_doing(std::string what);

  mutable std::mutex mutex_;
  std::string doing_;
  std::string within_;  ///< the loading thread's own: what is said before
};

/// Thrown out of whatever loads when the watch says so. No InputError: nothing is wrong with the
/// input. What was loaded so far is gone.
class LoadCancelled : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "loading was cancelled"; }
};

/// While it lives, everything that this thread loads or generates (load_scene, read_model,
/// make_sample_scene, …) is followed by `watch`, which must outlive it.
///
/// Bound to the thread instead of passed on: readers and generators lie up to ten calls below
/// load_scene, in folders and libraries that would otherwise carry a pointer that they never use.
/// Readers and generators look at the flag every few milliseconds of work, at most every 50.
class LoadScope {
 public:
  /// Null: what was in force goes on.
  explicit LoadScope(LoadWatch* watch);
  LoadScope(const LoadScope&) = delete;
  LoadScope& operator=(const LoadScope&) = delete;
  ~LoadScope();

  /// Nobody watches this thread from now on. For child processes, in which nobody could.
  static void leave_all();

 private:
  LoadWatch* watch_;
  LoadWatch* outer_watch_;
  double outer_from_, outer_to_;
  int exceptions_;
};

// The readers' side. Without a watch these do nothing.

/// Throws LoadCancelled if the loading is to end.
void check_load();
/// The same; `share` of the present part is done.
void report_load(double share);
/// Says what is being read from now on.
void note_load(const std::string& what);

/// For loops: reports before every 4096th round and before the first.
inline void report_load(std::size_t round, std::size_t rounds) {
  if (round % 4096 == 0) report_load(static_cast<double>(round) / static_cast<double>(rounds));
}

/// While it lives, progress from 0 to 1 means that from `from` to `to` of the part around it.
class LoadPart {
 public:
  /// `within`: stands before what note_load() says, as in "frame 3 of 120, ".
  LoadPart(double from, double to, const std::string& within = {});
  LoadPart(const LoadPart&) = delete;
  LoadPart& operator=(const LoadPart&) = delete;
  ~LoadPart();

 private:
  double outer_from_, outer_to_;
  std::string outer_within_;
};

/// One frame of a sequence: its part of the progress and its number.
class FramePart {
 public:
  FramePart(std::size_t frame, std::size_t frames);

 private:
  LoadPart part_;
};

/// The result of `work`, which is that part of the loading.
template <class Work>
auto in_load_part(double from, double to, const Work& work) {
  const LoadPart part(from, to);
  return work();
}

}  // namespace encore::scene
