#pragma once

#include "app/profile_report.h"
#include "energy/session.h"
#include "energy/sources/csv_replay.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace encore::app {

/// What is known of a recording's clock beforehand. Offsets are added to the recording's times to
/// get those of the session.
struct AttachOptions {
  std::optional<energy::Seconds> offset;  ///< exactly: nothing is aligned
  std::optional<energy::Seconds> near;    ///< roughly
  energy::Seconds within{5.0};            ///< how far the true one lies from `near` at most
};

/// Where a recording lies on the session's clock.
struct RecordingPlace {
  energy::Seconds offset;
  energy::Seconds half_width;         ///< of its 95 % interval
  std::optional<double> correlation;  ///< of the loads; nothing if the offset was given
  energy::Seconds overlap;            ///< of the session's windows and the recording
};

/// A session with the energies of a recording.
struct Attached {
  RecordingPlace place;
  energy::Session session;
  std::vector<ProfileReport::Notes> notes;  ///< of each configuration
  std::vector<std::string> warnings;        ///< about the whole
};

/// Loads a meter's recording. Throws scene::InputError.
energy::Recording open_recording(const std::string& file);

/// Aligns `recording` with the load steps of `session` (sampling/align.h; where nothing is known of
/// its clock, the fit must be a good one, as other runs fit a little, too) and attributes its
/// energy to every configuration (attribution/attribution.h; docs/measuring.md). Windows are
/// narrowed by the offset's half-width on both sides, so that none holds what another load took.
///
/// The result is the session with the recording as the one source of its figures; what other
/// sources saw stays as samples and phases of theirs, and frames stay as they are. A configuration
/// that the recording does not cover has no energy, whatever it had before. Of a session that was
/// resumed, only what came after counts: its clock left out the pause.
///
/// `folder`: the session's name for messages. Throws scene::InputError with the reason and the way
/// out if the recording cannot be aligned or covers no configuration.
Attached attach_recording(const std::string& folder, const energy::Session& session,
                          const energy::Recording& recording, const AttachOptions& options);

/// Writes it into `folder`, which exists and is empty, with the machine's log of the session in
/// `old_folder`. Throws energy::SessionError.
void write_attached(const std::filesystem::path& folder, const std::filesystem::path& old_folder,
                    const Attached& attached);

/// What `encore attach` prints.
ProfileReport attach_report(const std::filesystem::path& folder, const Attached& attached);

}  // namespace encore::app
