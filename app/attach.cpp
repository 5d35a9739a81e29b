#include "app/attach.h"

#include "app/attach_timeline.h"
#include "app/energy_rows.h"
#include "app/session_input.h"
#include "energy/attribution/attribution.h"
#include "energy/sampling/align.h"
#include "scene/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace encore::app {

namespace {

using energy::Seconds;
using energy::SummaryRow;
using energy::Window;

/// Without a hint, the loads must correlate so well. Recordings of other runs reached 0.76 in
/// simulations of short sessions; those of the run itself, with loads of very different power,
/// 0.81.
constexpr double kSureCorrelation = 0.8;
/// A given offset is compared with the best one this close to it.
constexpr Seconds kCheckedRange(5.0);
/// Half-widths of 95 % intervals in standard uncertainties.
constexpr double kHalfWidth = 1.96;
/// A session busy for a larger share of its time has no steps.
constexpr double kAlwaysBusy = 0.98;
/// Of a phase's span, so much may lie on the wrong side of its edges before it is said.
constexpr double kBlurredShare = 0.05;
/// How the event of a resumed session begins.
constexpr std::string_view kResumed = "the study was resumed";

/// When the session was resumed for the last time; nothing if it ran in one go.
std::optional<Seconds> last_resume(const energy::Session& session) {
  std::optional<Seconds> last;
  for (const energy::EventRow& event : session.events) {
    if (event.message.starts_with(kResumed) && (!last || event.time > *last)) last = event.time;
  }
  return last;
}

std::string offset_text(const RecordingPlace& place) {
  std::string text = fmt::format("{:+.3f} s", place.offset.value);
  if (place.correlation) text += fmt::format(" ± {:.3f} s", place.half_width.value);
  return text;
}

RecordingPlace found_place(const SessionLoad& load, const energy::Recording& recording,
                           const AttachOptions& options) {
  Seconds busy;
  for (const energy::PhaseSpan& span : load.busy) busy += span.end - span.start;
  if (busy > (load.to - load.from) * kAlwaysBusy) {
    throw scene::InputError(fmt::format(
        "{}: the session was never idle, so there are no steps of load to align it by; profile "
        "again with --idle 5, or give the offset by --offset S",
        recording.file));
  }
  energy::AlignmentSettings settings;
  settings.near = options.near;
  settings.range = options.within;
  if (!settings.near) settings.least_correlation = kSureCorrelation;
  const energy::AlignmentResult result =
      energy::align(load.busy, load.from, load.to, recording.trace, settings);
  if (!result.alignment) {
    throw scene::InputError(
        fmt::format("{}: {} (--near S gives the offset within {:g} s, --offset S exactly)",
                    recording.file, result.reason, options.within.value));
  }
  RecordingPlace place;
  place.offset = result.alignment->offset;
  place.half_width = result.alignment->uncertainty * kHalfWidth;
  place.correlation = result.alignment->correlation;
  return place;
}

/// The given offset, and what is to be said about it.
RecordingPlace given_place(const SessionLoad& load, const energy::Recording& recording,
                           Seconds offset, std::vector<std::string>& warnings) {
  RecordingPlace place;
  place.offset = offset;
  // Where within a row an edge fell cannot be seen.
  place.half_width = recording.spacing * (kHalfWidth / std::sqrt(12.0));
  energy::AlignmentSettings settings;
  settings.near = offset;
  settings.range = kCheckedRange;
  const auto best =
      energy::align(load.busy, load.from, load.to, recording.trace, settings).alignment;
  if (!best) return place;
  const double known = best->uncertainty.value * 3 + recording.spacing.value;
  if (std::fabs((best->offset - offset).value) > known) {
    warnings.push_back(fmt::format(
        "the steps of load fit better at an offset of {:+.3f} s (correlation {:.3f}) than at the "
        "given {:+.3f} s",
        best->offset.value, best->correlation, offset.value));
  }
  return place;
}

/// Finds the offset, or takes what is given, and adds what is to be said about it.
RecordingPlace place_of(const SessionLoad& load, const energy::Recording& recording,
                        const AttachOptions& options, std::vector<std::string>& warnings) {
  RecordingPlace place = options.offset ? given_place(load, recording, *options.offset, warnings)
                                        : found_place(load, recording, options);
  const auto& points = recording.trace.points();
  place.overlap = std::min(load.to, points.back().time + place.offset) -
                  std::max(load.from, points.front().time + place.offset);
  if (place.overlap.value <= 0) {
    throw scene::InputError(
        fmt::format("{}: with {:+.3f} s added to its clock it lies outside of the session ({:.1f} "
                    "to {:.1f} s); the offset is the session's time minus the recording's",
                    recording.file, place.offset.value, load.from.value, load.to.value));
  }
  return place;
}

/// Each window without its edges; those of which less than half is left are dropped.
std::vector<Window> narrowed(const std::vector<Window>& windows, Seconds edge) {
  std::vector<Window> narrow;
  for (const Window& window : windows) {
    if (window.to - window.from >= edge * 4.0) {
      narrow.push_back({window.from + edge, window.to - edge});
    }
  }
  return narrow;
}

/// What windows.csv tells of a configuration.
struct Windows {
  /// The last, if it was cut off and measured anew; all slots of a session of the window.
  std::vector<Window> measured;
  std::vector<Window> idle;
};

Windows windows_of(const energy::Session& session, const SummaryRow& row, Seconds since) {
  Windows windows;
  const bool by_turns = session.info.plan.name == "window";
  for (const energy::WindowRow& window : session.windows) {
    if (window.from < since || window.to <= window.from) continue;
    if (window.configuration != row.configuration) continue;
    if (window.kind == "measured") {
      if (!by_turns) windows.measured.clear();
      windows.measured.push_back({window.from, window.to});
    }
    if (window.kind == "idle") windows.idle.push_back({window.from, window.to});
  }
  return windows;
}

/// Forgets the energies that another source gave.
void clear_energy(SummaryRow& row) {
  row.source.clear();
  row.watts = row.watts_ci95 = row.idle_watts = row.idle_watts_ci95 = std::nullopt;
  row.joules = row.joules_ci95 = row.net_joules = row.net_joules_ci95 = std::nullopt;
  row.origin = energy::Origin::unavailable;
  for (energy::Counter& counter : row.counters) {
    const bool of_energy =
        counter.name.starts_with("joules_") || counter.name.starts_with("energy_");
    if (!of_energy || !counter.value) continue;
    counter.value.reset();
    counter.unavailable = true;
  }
}

/// Attributes the recording's energy to the session's configurations.
class Attacher {
 public:
  Attacher(const energy::Session& session, const energy::Recording& recording, Attached& attached,
           Seconds since)
      : old_(session),
        attached_(attached),
        since_(since),
        info_(energy::replay_info(recording)),
        trace_(energy::aligned_trace(recording, attached.place.offset)) {
    info_.provenance.detail += ", clock " + offset_text(attached.place);
  }

  /// Whether any configuration has energy now.
  bool run() {
    start_session();
    bool any = false;
    for (SummaryRow& row : attached_.session.summaries) {
      clear_energy(row);
      ProfileReport::Notes notes{configuration_name(row.configuration), {}};
      add_energies(row, notes.sentences);
      any = any || row.watts.has_value();
      for (const std::string& note : notes.sentences) {
        note_event("", notes.name + ": " + note);
      }
      attached_.notes.push_back(std::move(notes));
    }
    add_samples();
    return any;
  }

 private:
  /// The old session with this source in the place of what its figures rested on.
  void start_session() {
    energy::Session& session = attached_.session;
    session = old_;
    for (energy::SessionSource& source : session.info.sources) source.in_total = false;
    const auto same = [&](const auto& row) { return row.source == info_.name; };
    std::erase_if(session.info.sources, [&](const energy::SessionSource& source) {
      return source.info.name == info_.name;
    });
    std::erase_if(session.samples, same);
    std::erase_if(session.phases,
                  [&](const auto& row) { return same(row) || row.source == "total"; });
    // How fast the joules of another source converged says nothing about these.
    std::erase_if(session.convergence, [](const energy::ConvergenceRow& row) {
      return row.quantity != "time_per_operation";
    });
    session.info.sources.push_back({info_, true});
    session.info.sensor = info_.provenance;
    if (session.info.state == energy::SessionState::running) {
      session.info.state = energy::SessionState::interrupted;
    }

    const RecordingPlace& place = attached_.place;
    std::string sentence =
        fmt::format("{} attached: {} are added to its clock, ", info_.place, offset_text(place));
    sentence += place.correlation
                    ? fmt::format(
                          "found by the steps of load (correlation {:.3f}, {:.1f} s in "
                          "common)",
                          *place.correlation, place.overlap.value)
                    : fmt::format("as given ({:.1f} s in common)", place.overlap.value);
    note_event(info_.name, sentence);
    for (const std::string& warning : attached_.warnings) note_event(info_.name, warning);
  }

  void note_event(const std::string& source, const std::string& sentence) {
    attached_.session.events.push_back({end_of_session(), source, sentence});
  }

  [[nodiscard]] Seconds end_of_session() const {
    Seconds end;
    for (const energy::WindowRow& window : old_.windows) end = std::max(end, window.to);
    return end;
  }

  void add_energies(SummaryRow& row, std::vector<std::string>& notes) {
    const Windows windows = windows_of(old_, row, since_);
    if (windows.measured.empty()) {
      notes.emplace_back("no energy: windows.csv does not say when it was measured");
      return;
    }
    const Seconds edge = attached_.place.half_width;
    energy::AttributionInput input;
    input.measured = narrowed(windows.measured, edge);
    if (input.measured.empty()) {
      notes.push_back(fmt::format(
          "no energy: its {:.3g} s are too short for a recording that is aligned to ± {:.2g} s",
          (windows.measured.back().to - windows.measured.back().from).value, edge.value));
      return;
    }
    input.idle = narrowed(windows.idle, edge);
    const energy::BusyTimeline busy = busy_in(old_.frames, windows.measured);
    input.busy = &busy;
    input.source = &info_;
    input.trace = part_around(windows);
    energy::Attribution attribution = energy::attribute(input);
    for (energy::PhaseEnergy& phase : attribution.phases) mark_blurred(phase);

    add_energy(attribution, row);
    if (row.watts) {
      row.source = info_.name;
      row.origin = info_.provenance.origin;
    }
    for (const std::string& source : {info_.name, std::string("total")}) {
      const auto rows = phase_rows(attribution, source, info_.provenance.origin, row.configuration);
      auto& phases = attached_.session.phases;
      phases.insert(phases.end(), rows.begin(), rows.end());
    }
    notes.insert(notes.end(), attribution.notes.begin(), attribution.notes.end());
  }

  /// The trace of a configuration and a little more on both sides.
  [[nodiscard]] energy::TraceView part_around(const Windows& windows) const {
    Window whole{windows.measured.front().from, windows.measured.back().to};
    for (const Window& idle : windows.idle) {
      whole = {std::min(whole.from, idle.from), std::max(whole.to, idle.to)};
    }
    const Seconds margin = info_.update_period * 5.0;
    return trace_.part(whole.from - margin, whole.to + margin);
  }

  /// A phase that is short against what the alignment leaves open holds some of its neighbours.
  void mark_blurred(energy::PhaseEnergy& phase) const {
    const bool alone = phase.method == energy::AttributionMethod::whole;
    if (alone || !phase.watts || !(phase.count > 0) || !phase.reason.empty()) return;
    const Seconds span = phase.busy / phase.count;
    const Seconds edge = attached_.place.half_width;
    if (edge <= span * kBlurredShare) return;
    phase.reason = fmt::format(
        "its spans of {:.3g} s are short for a recording that is aligned to ± {:.2g} s: the number "
        "holds some of its neighbours' energy",
        span.value, edge.value);
  }

  void add_samples() {
    const energy::TraceView part = trace_.part(std::min(since_, Seconds(0)), end_of_session());
    std::vector<energy::SampleRow>& samples = attached_.session.samples;
    const energy::TracePoint* last = nullptr;
    for (const energy::TracePoint& point : part.points()) {
      energy::SampleRow row;
      row.time = point.time;
      row.source = info_.name;
      row.joules = point.energy - part.points().front().energy;
      row.watts = point.power;
      row.changed = point.changed;
      row.restarted = last != nullptr && point.starts_stretch;
      row.origin = info_.provenance.origin;
      if (!row.watts && last != nullptr && !row.restarted) {
        row.watts = (point.energy - last->energy) / (point.time - last->time);
      }
      samples.push_back(std::move(row));
      last = &point;
    }
    std::stable_sort(samples.begin(), samples.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
  }

  const energy::Session& old_;
  Attached& attached_;
  Seconds since_;
  energy::SourceInfo info_;
  energy::TraceView trace_;
};

}  // namespace

Attached attach_recording(const std::string& folder, const energy::Session& session,
                          const energy::Recording& recording, const AttachOptions& options) {
  const std::optional<Seconds> resumed = last_resume(session);
  const Seconds since = resumed.value_or(Seconds(0));
  const SessionLoad load = load_of(session, since);
  if (session.summaries.empty() || !(load.to > load.from)) {
    throw scene::InputError(
        fmt::format("{}: no configuration was measured to its end; name a session that 'encore "
                    "profile' has finished",
                    folder));
  }
  Attached attached;
  if (resumed) {
    attached.warnings.emplace_back(
        "the session was resumed: only what was measured after that gets energies");
  }
  attached.place = place_of(load, recording, options, attached.warnings);
  if (!Attacher(session, recording, attached, since).run()) {
    const auto& sentences = attached.notes.front().sentences;
    throw scene::InputError(
        fmt::format("{}: no configuration of {} gets any energy from it ({})", recording.file,
                    folder, sentences.empty() ? "it tells no power" : sentences.front()));
  }
  return attached;
}

}  // namespace encore::app
