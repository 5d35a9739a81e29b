// Feeds arbitrary bytes to the reader of CSV recordings, and plays what it made of them: finite
// rows in the order of time, or SensorError.
#include "energy/sources/csv_replay.h"
#include "energy/sources/discovery.h"
#include "tests/fuzz/check_text.h"
#include "tests/support/files.h"

namespace {

using namespace encore;
using namespace encore::energy;

void check_rows(const Recording& recording) {
  fuzz::require_finite(recording.spacing);
  fuzz::require(recording.spacing > Seconds(0));
  const TracePoint* last = nullptr;
  for (const TracePoint& point : recording.trace.points()) {
    fuzz::require_finite(point.time);
    fuzz::require_finite(point.energy);
    fuzz::require_finite(point.power);
    fuzz::require(last == nullptr || (point.time > last->time && point.energy >= last->energy));
    last = &point;
  }
}

/// Reads at the rows' times and between them.
void play(const Recording& recording) {
  const auto source = open_replay(recording, Seconds(0));
  const auto read = [&](Seconds time) {
    const ReadResult result = source->read(time);
    if (result.state == ReadState::ok || result.state == ReadState::restarted) {
      fuzz::require_finite(result.reading.energy);
      fuzz::require_finite(result.reading.power);
    }
  };
  const std::vector<TracePoint>& points = recording.trace.points();
  for (std::size_t i = 0; i < points.size() && i < 64; ++i) {
    read(points[i].time);
    if (i + 1 < points.size()) read(points[i].time + (points[i + 1].time - points[i].time) / 2);
  }
  (void)open_replay(recording)->read(Seconds(5));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryFolder folder;
  const auto file = folder.write("r.csv", fuzz::text_of(data, size));
  fuzz::check_parser<SensorError>([&] {
    const Recording recording = load_recording(file);
    check_rows(recording);
    play(recording);
  });
  return 0;
}
