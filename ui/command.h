#pragma once

#include "ui/accuracy_state.h"
#include "ui/settings.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace encore::ui {

// What panels ask for. The application carries commands out between frames; none of them waits.

struct OpenScene {
  std::string name_or_path;  ///< as on the command line
};
struct ReloadScene {};
/// Ends what a pane is doing, or the loading of a scene.
struct CancelWork {
  std::optional<std::size_t> pane;  ///< nothing: loading
};
/// Goes on after a cancel, or builds again though nothing changed.
struct Rebuild {
  std::size_t pane = 0;
};
/// The mouse is at a pixel of the pane's picture.
struct HoverPixel {
  std::size_t pane = 0;
  int x = 0;
  int y = 0;
};
/// Follow the ray of a pixel through the pane's structure.
struct PickPixel {
  std::size_t pane = 0;
  int x = 0;
  int y = 0;
};
struct ClearPick {};
/// Select the node under a pixel of the 3D view.
struct PickNode {
  int x = 0;
  int y = 0;
};
struct StartRecording {};
struct PauseRecording {
  bool paused = true;
};
struct StopRecording {};
struct Annotate {
  std::string text;
};
/// Forget what measure mode has found so far.
struct ClearResults {};
struct OpenSession {
  std::filesystem::path folder;
};
struct CompareSession {
  std::filesystem::path folder;  ///< against the session that is open
};
struct CloseSession {};
struct CancelSession {};  ///< the reading of one
struct ExportSession {
  std::filesystem::path from;
  std::filesystem::path to;
};
/// Opens the power sources that the settings name.
struct ApplyEnergy {};
/// Looks at the sensors of this machine.
struct ExamineSensors {
  bool stop = false;
};
/// Holds every combination to a reference, in the place of what was found before.
struct StartAccuracy {
  AccuracyChoice choice;
};
struct StopAccuracy {};
/// Measures how long frames would take with what the scene does without.
struct MeasureLeftOut {};
/// Writes what was found to a new folder among the pictures: accuracy.csv and the scatter as SVG.
struct SaveAccuracy {};
enum class PictureOf { pane_0, pane_1, structure_view, plots, window, accuracy };
struct SavePicture {
  PictureOf what = PictureOf::window;
  std::filesystem::path file;  ///< empty: a name of its own in the pictures' folder
};
struct CopyText {
  std::string text;
  std::string told;  ///< what the user is told: "camera copied"
};
struct SaveText {
  std::filesystem::path file;
  std::string text;
};
struct ToggleFullScreen {};
struct Quit {};

using Command =
    std::variant<OpenScene, ReloadScene, CancelWork, Rebuild, HoverPixel, PickPixel, ClearPick,
                 PickNode, StartRecording, PauseRecording, StopRecording, Annotate, ClearResults,
                 OpenSession, CompareSession, CloseSession, CancelSession, ExportSession,
                 ApplyEnergy, ExamineSensors, StartAccuracy, StopAccuracy, SaveAccuracy,
                 MeasureLeftOut, SavePicture, CopyText, SaveText, ToggleFullScreen, Quit>;
using Commands = std::vector<Command>;

}  // namespace encore::ui
