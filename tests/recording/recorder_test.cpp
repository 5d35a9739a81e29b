#include "app/window/recorder.h"

#include "app/window/export.h"
#include "app/window/opened_session.h"
#include "energy/session_csv.h"
#include "recording_world.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace encore::app {
namespace {

namespace fs = std::filesystem;

/// A world that is recorded.
class Recorded : public ::testing::Test {
 protected:
  void start(const fs::path& where) {
    RecordingSetup setup;
    setup.folder = where;
    setup.command_line = "encore";
    setup.scenes = {"toys"};
    recorder.start(setup);
    ASSERT_TRUE(eventually([&] { return recorder.state().mode != RecorderMode::starting; }));
    ASSERT_EQ(recorder.state().mode, RecorderMode::recording) << recorder.state().message;
  }
  void stop() {
    recorder.stop();
    recorder.wait();
  }
  void turn(double seconds = 0.5) {
    world.idle(0.3);
    world.load(RecordingWorld::slot_of("cpu"), seconds, 0.020, 50.0, Device::cpu);
    world.idle(0.3);
    world.load(RecordingWorld::slot_of("gpu"), seconds, 0.007, 80.0, Device::gpu);
  }
  static OpenedSession open(const fs::path& where) {
    TaskControl control;
    return read_opened_session(where, control);
  }

  TemporaryFolder folder;
  RecordingWorld world;
  Recorder recorder{world.monitor(), world.attribution()};
};

TEST_F(Recorded, TheFolderReadsBackAsWhatWasMeasured) {
  start(folder / "s");
  for (int i = 0; i < 3; ++i) turn();
  world.idle(0.3);
  stop();
  EXPECT_EQ(recorder.state().mode, RecorderMode::off);
  EXPECT_EQ(recorder.state().message, "recorded");

  const energy::Session session = energy::read_session(folder / "s");
  EXPECT_EQ(session.info.state, energy::SessionState::complete);
  EXPECT_EQ(session.info.plan.name, "window");
  ASSERT_EQ(session.info.sources.size(), 1U);
  EXPECT_TRUE(session.info.sources[0].in_total);
  EXPECT_EQ(session.info.sensor.origin, energy::Origin::simulated);
  EXPECT_EQ(session.frames.size(), recorder.state().rows);
  EXPECT_EQ(session.samples.size(), recorder.state().samples);
  EXPECT_GT(recorder.state().bytes, 1000U);
  ASSERT_EQ(session.summaries.size(), 2U);
  // Rows, summary and window's own figures are of the same operations.
  const auto figures = world.attribution().compute();
  ASSERT_EQ(figures->configurations.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const energy::SummaryRow& row = session.summaries[i];
    EXPECT_EQ(row.operations, figures->configurations[i].summary.operations);
    EXPECT_DOUBLE_EQ(row.mean.value, figures->configurations[i].summary.mean.value);
    ASSERT_TRUE(row.joules);
    EXPECT_DOUBLE_EQ(row.joules->value, figures->configurations[i].summary.joules->value);
    std::uint64_t operations = 0;
    for (const energy::FrameRow& frame : session.frames) {
      if (frame.configuration == row.configuration) operations += frame.operations;
    }
    EXPECT_EQ(operations, row.operations);
    std::size_t measured = 0;
    std::size_t idle = 0;
    for (const energy::WindowRow& window : session.windows) {
      if (window.configuration != row.configuration) continue;
      (window.kind == "measured" ? measured : idle) += 1;
    }
    EXPECT_EQ(measured, 3U);
    EXPECT_GE(idle, 5U);
  }
  for (const energy::FrameRow& frame : session.frames) {
    EXPECT_TRUE(frame.operation_joules);
  }
  EXPECT_FALSE(session.convergence.empty());
  EXPECT_FALSE(session.phases.empty());

  const OpenedSession opened = open(folder / "s");
  EXPECT_FALSE(opened.cut_off);
  EXPECT_FALSE(opened.recomputed);
  EXPECT_TRUE(opened.remarks.empty());
  EXPECT_EQ(opened.session.frames, session.frames);
  EXPECT_EQ(opened.session.summaries, session.summaries);
  EXPECT_EQ(opened.session.phases, session.phases);
  EXPECT_EQ(opened.session.windows, session.windows);
  EXPECT_EQ(opened.session.events, session.events);
  EXPECT_EQ(opened.session.convergence, session.convergence);
  ASSERT_EQ(opened.series.size(), 1U);
  ASSERT_EQ(opened.series[0].points.size(), session.samples.size());
  for (std::size_t i = 0; i < session.samples.size(); ++i) {
    EXPECT_EQ(opened.series[0].points[i].time_s, session.samples[i].time.value);
    EXPECT_EQ(opened.series[0].points[i].joules, session.samples[i].joules->value);
  }
  ASSERT_EQ(opened.bars.size(), 2U);
  ASSERT_FALSE(opened.bars[0].phases.empty());
  EXPECT_EQ(opened.bars[0].phases[0].phase, "render");
  EXPECT_TRUE(opened.bars[0].phases[0].joules && opened.bars[0].phases[0].joules->half_width);
  EXPECT_NE(opened.machine_card.find("energy: simulated"), std::string::npos);
}

TEST_F(Recorded, APauseLeavesAGap) {
  start(folder / "s");
  turn();
  recorder.pause();
  EXPECT_EQ(recorder.state().mode, RecorderMode::paused);
  turn();
  recorder.annotate("window opened");
  recorder.resume();
  turn();
  stop();
  const energy::Session session = energy::read_session(folder / "s");
  double paused = -1.0;
  double resumed = -1.0;
  bool annotated = false;
  for (const energy::EventRow& event : session.events) {
    if (event.message == "recording paused") paused = event.time.value;
    if (event.message == "recording resumed") resumed = event.time.value;
    annotated = annotated || (event.message == "window opened" && event.source.empty());
  }
  EXPECT_TRUE(annotated);
  ASSERT_GT(resumed, paused + 1.0);
  std::size_t restarted = 0;
  for (const energy::SampleRow& row : session.samples) {
    EXPECT_FALSE(row.time.value > paused && row.time.value < resumed);
    if (!row.restarted) continue;
    ++restarted;
    EXPECT_GE(row.time.value, resumed);
  }
  EXPECT_EQ(restarted, 1U);
  for (const energy::FrameRow& row : session.frames) {
    EXPECT_FALSE(row.time.value > paused && row.time.value < resumed);
  }
  for (const energy::WindowRow& row : session.windows) {
    EXPECT_TRUE(row.to.value <= paused || row.from.value >= resumed);
  }
  EXPECT_NEAR(recorder.state().seconds, 2 * 1.6, 0.2);
}

TEST_F(Recorded, ASlotUnderWayIsSplitByAPause) {
  start(folder / "s");
  const Slot cpu = RecordingWorld::slot_of("cpu");
  world.attribution().slot_began(cpu);
  const auto frames = [&] {
    for (int i = 0; i < 20; ++i) {
      const energy::Seconds began = world.attribution().begin_operation();
      world.pass(energy::Seconds(0.02), 50.0);
      const energy::PhaseSpan span{energy::Phase::render, began, world.clock().now()};
      world.attribution().operation({&span, 1}, began, world.clock().now());
    }
  };
  frames();
  recorder.pause();
  frames();
  recorder.resume();
  frames();
  world.attribution().slot_ended();
  stop();
  const energy::Session session = energy::read_session(folder / "s");
  ASSERT_EQ(session.windows.size(), 2U);
  ASSERT_EQ(session.summaries.size(), 1U);
  EXPECT_EQ(session.summaries[0].operations, 40U);
}

TEST_F(Recorded, WordsOfTheUserStayAsTheyAre) {
  start(folder / "s");
  const std::string words = "lid closed, \"fan\" on\nand a line";
  recorder.annotate(words);
  stop();
  const OpenedSession opened = open(folder / "s");
  bool found = false;
  for (const energy::EventRow& event : opened.session.events) found |= event.message == words;
  EXPECT_TRUE(found);
}

TEST_F(Recorded, ANewSensorIsNotedAndStartsAStretch) {
  start(folder / "s");
  turn();
  MeasuringOptions options;
  options.sources = {"simulated:b"};
  world.monitor().choose(options);
  world.monitor().wait_until_open();
  turn();
  options.sources = {"simulated:a"};
  world.monitor().choose(options);
  world.monitor().wait_until_open();
  turn();
  stop();
  const OpenedSession opened = open(folder / "s");
  ASSERT_EQ(opened.series.size(), 2U);
  std::size_t gaps = 0;
  for (const PowerPoint& point : opened.series[0].points) gaps += point.gap ? 1 : 0;
  EXPECT_EQ(gaps, 2U);  // the first of all, and where it came back
  bool noted = false;
  for (const energy::EventRow& event : opened.session.events) {
    noted |= event.message == "power sources: simulated:b";
  }
  EXPECT_TRUE(noted);
}

TEST_F(Recorded, AFolderThatHoldsSomethingIsRefusedAndNothingElseStops) {
  fs::create_directory(folder / "s");
  std::ofstream(folder / "s/mine.txt") << "mine";
  RecordingSetup setup;
  setup.folder = folder / "s";
  recorder.start(setup);
  ASSERT_TRUE(eventually([&] { return recorder.state().mode == RecorderMode::failed; }));
  EXPECT_TRUE(recorder.state().message.starts_with("recording stopped: "));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "s"), fs::directory_iterator()), 1);
  // It can be started again, elsewhere.
  start(folder / "t");
  turn();
  stop();
  EXPECT_EQ(energy::read_session(folder / "t").info.state, energy::SessionState::complete);
}

TEST_F(Recorded, AFolderThatVanishesEndsTheRecordingOnly) {
  start(folder / "s");
  turn();
  fs::remove_all(folder / "s");
  EXPECT_TRUE(eventually([&] {
    turn(0.1);
    return recorder.state().mode == RecorderMode::failed;
  }));
  EXPECT_NE(recorder.state().message.find("is gone"), std::string::npos);
  (void)world.monitor().drain();
  world.pass(energy::Seconds(0.5), 50.0);
  EXPECT_FALSE(world.monitor().drain().points.empty());
}

TEST_F(Recorded, ACopyIsTheSameAndOverwritesNothing) {
  start(folder / "s");
  turn();
  stop();
  TaskControl control;
  const ExportResult result = export_session(folder / "s", folder / "copy", control);
  EXPECT_GE(result.files, 8U);
  EXPECT_EQ(control.progress, 1.0);
  EXPECT_FALSE(fs::exists(folder / "copy.partial"));
  for (const fs::directory_entry& file : fs::directory_iterator(folder / "s")) {
    const auto content = [](const fs::path& path) {
      std::ostringstream text;
      text << std::ifstream(path, std::ios::binary).rdbuf();
      return text.str();
    };
    EXPECT_EQ(content(file.path()), content((folder / "copy") / file.path().filename()));
  }
  EXPECT_THROW((void)export_session(folder / "s", folder / "copy", control), energy::SessionError);
  EXPECT_THROW((void)export_session(folder / "none", folder / "d", control), energy::SessionError);
  control.stop = true;
  EXPECT_THROW((void)export_session(folder / "s", folder / "e", control), energy::SessionError);
  EXPECT_FALSE(fs::exists(folder / "e"));
  EXPECT_FALSE(fs::exists(folder / "e.partial"));
}

}  // namespace
}  // namespace encore::app
