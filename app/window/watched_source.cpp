#include "app/window/watched_source.h"

#include <string_view>
#include <utility>

namespace encore::app {

namespace {

constexpr std::string_view kConstants = "model:constants";

bool works_by_marks(const energy::SourceInfo& info) {
  return info.kind == energy::SourceKind::simulated || info.name == kConstants;
}

}  // namespace

WatchedSource::WatchedSource(std::unique_ptr<energy::PowerSource> source,
                             std::optional<energy::Seconds> poll,
                             std::shared_ptr<const BusyMarks> busy)
    : source_(std::move(source)), info_(source_->info()) {
  if (poll) info_.poll_period = *poll;
  if (works_by_marks(info_)) busy_ = std::move(busy);
}

energy::ReadResult WatchedSource::read(energy::Seconds now) {
  energy::ReadResult result = source_->read(now);
  if (!busy_) return result;
  const bool overlapped = last_ && busy_->overlapped(*last_, now);
  last_ = now;
  if (overlapped) {
    refused_ = true;
    return {energy::ReadState::failed,
            {},
            info_.name +
                ": no value while both devices work at once, since it knows one at a time; measure "
                "mode lets them take turns"};
  }
  if (refused_ && result.state == energy::ReadState::ok) {
    result.state = energy::ReadState::restarted;
    result.message = info_.name + ": one device at a time again";
    refused_ = false;
  }
  return result;
}

}  // namespace encore::app
