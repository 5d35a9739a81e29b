#include "scene/load_watch.h"

#include <algorithm>
#include <utility>

namespace encore::scene {

namespace {

/// Who follows this thread, and what its present part is of the whole.
struct Following {
  LoadWatch* watch = nullptr;
  double from = 0.0;
  double to = 1.0;
};
thread_local Following following;

}  // namespace

std::string LoadWatch::doing() const {
  const std::lock_guard lock(mutex_);
  return doing_;
}

void LoadWatch::set_doing(std::string what) {
  const std::lock_guard lock(mutex_);
  doing_ = std::move(what);
}

LoadScope::LoadScope(LoadWatch* watch)
    : watch_(watch),
      outer_watch_(following.watch),
      outer_from_(following.from),
      outer_to_(following.to),
      exceptions_(std::uncaught_exceptions()) {
  if (watch_ == nullptr) return;
  watch_->progress.store(0.0F, std::memory_order_relaxed);
  watch_->looks = 0;
  watch_->set_doing({});
  watch_->within_.clear();
  following = {watch_, 0.0, 1.0};
}

LoadScope::~LoadScope() {
  if (watch_ == nullptr) return;
  const bool well = std::uncaught_exceptions() == exceptions_;
  if (well) watch_->progress.store(1.0F, std::memory_order_relaxed);
  following = {outer_watch_, outer_from_, outer_to_};
}

void LoadScope::leave_all() {
  following = {};
}

void check_load() {
  LoadWatch* const watch = following.watch;
  if (watch == nullptr) return;
  ++watch->looks;
  const bool asked = watch->cancel != nullptr && watch->cancel->load(std::memory_order_relaxed);
  if (asked || watch->looks >= watch->last_look) throw LoadCancelled();
}

void report_load(double share) {
  LoadWatch* const watch = following.watch;
  if (watch == nullptr) return;
  const double whole =
      following.from + std::clamp(share, 0.0, 1.0) * (following.to - following.from);
  const float before = watch->progress.load(std::memory_order_relaxed);
  watch->progress.store(std::max(before, static_cast<float>(whole)), std::memory_order_relaxed);
  check_load();
}

void note_load(const std::string& what) {
  if (following.watch != nullptr) following.watch->set_doing(following.watch->within_ + what);
}

LoadPart::LoadPart(double from, double to, const std::string& within)
    : outer_from_(following.from), outer_to_(following.to) {
  if (following.watch != nullptr) {
    outer_within_ = following.watch->within_;
    following.watch->within_ += within;
  }
  const double width = outer_to_ - outer_from_;
  following.from = outer_from_ + from * width;
  following.to = outer_from_ + to * width;
}

LoadPart::~LoadPart() {
  if (following.watch != nullptr) following.watch->within_ = outer_within_;
  following.from = outer_from_;
  following.to = outer_to_;
}

FramePart::FramePart(std::size_t frame, std::size_t frames)
    : part_(static_cast<double>(frame) / static_cast<double>(frames),
            static_cast<double>(frame + 1) / static_cast<double>(frames),
            "frame " + std::to_string(frame + 1) + " of " + std::to_string(frames) + ", ") {
  report_load(0.0);
}

}  // namespace encore::scene
