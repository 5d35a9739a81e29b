// Measuring and keeping what was measured.
#include "window_test.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <sstream>

namespace encore::test {

namespace {

namespace fs = std::filesystem;

std::size_t lines_of(const fs::path& file) {
  const std::string text = contents_of(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// "● recording 12 s, 34 rows"
struct Recorded {
  double seconds = 0.0;
  int rows = 0;
};
Recorded recorded(const WidgetMap& map) {
  const std::string text = map.state("status.recorder");
  Recorded found;
  const std::size_t digits = text.find_first_of("0123456789");
  const std::size_t comma = text.find(", ");
  if (digits != std::string::npos) found.seconds = std::atof(text.c_str() + digits);
  if (comma != std::string::npos) found.rows = std::atoi(text.c_str() + comma + 2);
  return found;
}

/// Seconds from the first to the last whole row of samples.csv.
double sampled_seconds(const fs::path& session) {
  std::istringstream file(contents_of(session / "samples.csv"));
  std::string line;
  std::getline(file, line);
  double first = -1.0;
  double last = 0.0;
  while (std::getline(file, line) && !file.eof()) {
    const double time = std::atof(line.c_str());
    if (first < 0.0) first = time;
    last = std::max(last, time);
  }
  return first < 0.0 ? 0.0 : last - first;
}

const std::vector<std::string> kModel{"--model", "idle=5,build=20,render=30"};

std::vector<std::string> with_model(std::string scene) {
  std::vector<std::string> arguments = kModel;
  arguments.insert(arguments.begin(), std::move(scene));
  return arguments;
}

/// Types a path into the file browser that is open.
void enter_path(Person& person, const fs::path& path) {
  person.click("browser.path");
  person.key("Ctrl+a");
  person.type(path.string());
  person.key("Return");
}

class RecordingWindow : public WindowTest {
 protected:
  /// In measure mode, until the recording holds so many rows of frames.
  void record(std::size_t rows) {
    person().key("m");
    person().key("Ctrl+r");
    person().see("status.recorder");
    ASSERT_TRUE(eventually([&] {
      return !sessions().empty() && lines_of(sessions().front() / "frames.csv") > rows;
    })) << "no frames are recorded";
  }
  /// The session that is open: with itself, and to a new folder.
  void compare_and_export(const fs::path& session) {
    person().click("sessions.compare");
    enter_path(person(), session);
    // Nothing differs from itself.
    person().see("sessions.changes.row.0");
    EXPECT_TRUE(contains(person().map().state("sessions.changes.row.0"), "noise"))
        << person().map().state("sessions.changes.row.0");
    person().look_calmly("compared");
    person().click("sessions.export");
    enter_path(person(), home().path());
    person().click("browser.name");
    person().key("Ctrl+a");
    person().type("exported");
    person().click("browser.choose");
    const fs::path copy = home().path() / "exported";
    EXPECT_TRUE(eventually([&] { return fs::exists(copy / "session.toml"); }));
    EXPECT_EQ(contents_of(copy / "frames.csv"), contents_of(session / "frames.csv"));
    EXPECT_EQ(contents_of(copy / "samples.csv"), contents_of(session / "samples.csv"));
  }
  void end_recording() {
    person().key("Ctrl+r");
    person().wait_until([](const WidgetMap& map) { return !map.has("status.recorder"); },
                        "the recording to end");
    person().key("m");
    ASSERT_EQ(sessions().size(), 1U);
    EXPECT_TRUE(eventually([this] {
      return contains(contents_of(sessions().front() / "session.toml"), "complete");
    })) << contents_of(sessions().front() / "session.toml");
  }
};

}  // namespace

TEST_F(RecordingWindow, RecordsAnnotatesExportsReopensAndCompares) {
  open_display(1800, 1000);
  Person& person = start(with_model("mug"), "1800x1000");
  person.see("pane.0.picture");
  person.wait_idle();
  record(4);
  person.key("Ctrl+m");
  person.see("annotate.text");
  person.type("the lamp, on");
  person.key("Return");
  person.wait_until([](const WidgetMap& map) { return !map.has("annotate.text"); },
                    "the dialog to close");
  person.look().keep("recording");
  end_recording();

  const fs::path session = sessions().front();
  for (const char* file : {"session.toml", "frames.csv", "summary.csv", "samples.csv"}) {
    EXPECT_GT(lines_of(session / file), 1U) << file;
  }
  EXPECT_TRUE(contains(contents_of(session / "events.csv"), "the lamp, on"));
  EXPECT_TRUE(contains(contents_of(session / "summary.csv"), "modelled"));

  person.choose({"menu.file", "menu.file.open_session"});
  enter_path(person, session);
  person.choose({"menu.measure", "menu.measure.sessions"});
  person.see_state("sessions.folder", session.string());
  person.see_state("sessions.state", "complete");
  EXPECT_EQ(person.map().state("sessions.show"), "on") << "the plots show it";
  EXPECT_EQ(person.map().state("bars.chart.legend.render"), "on");
  EXPECT_TRUE(contains(person.map().state("error.configuration"), "bvh-median"));
  person.look_calmly("session");
  compare_and_export(session);
  close();
}

TEST_F(RecordingWindow, FillsTheBarsWithModelledJoules) {
  open_display(1800, 1000);
  Person& person = start(with_model("mug"), "1800x1000");
  person.see("pane.0.picture");
  person.see_state("menu.provenance", "modelled");
  person.key("m");
  const WidgetMap map = person.wait_until(
      [](const WidgetMap& now) {
        return contains(now.state("pane.0.joules"), "J") &&
               contains(now.state("pane.1.joules"), "J");
      },
      "joules a frame of both panes");
  EXPECT_EQ(map.state("pane.0.badge"), "modelled");
  EXPECT_EQ(map.state("pane.1.badge"), "modelled");
  EXPECT_FALSE(map.has("power_line.text"));
  EXPECT_EQ(map.state("bars.chart.legend.render"), "on");
  const Widget bars = person.see("bars.chart");
  const Screenshot shot = person.look();
  shot.keep("measuring");
  EXPECT_GT(shot.colors(area_of(bars)), 4U) << "no bars are drawn";
  EXPECT_GT(shot.colors(area_of(person.see("power.chart"))), 4U) << "no trace is drawn";
  person.key("m");
  close();
}

TEST_F(RecordingWindow, TakesIdleAndBusyWattsByHand) {
  Person& person = start([this] {
    std::vector<std::string> arguments = no_sensors();
    arguments.emplace_back("mug");
    return arguments;
  }());
  person.see_state("menu.provenance", "unavailable");
  person.click("power_line.watts");
  person.see("dialog.energy");
  person.click("energy.model");
  for (const auto& [field, watts] :
       {std::pair{"energy.idle", "11"}, std::pair{"energy.busy", "27"}}) {
    person.click(field);
    person.key("Ctrl+a");
    person.type(watts);
    person.key("Return");
  }
  person.look_calmly("energy-dialog");
  person.click("energy.apply");
  person.see_state("menu.provenance", "modelled");
  person.look_calmly("watts-entered");
  close();
  // They are kept.
  start([this] {
    std::vector<std::string> arguments = no_sensors();
    arguments.emplace_back("mug");
    return arguments;
  }())
      .see_state("menu.provenance", "modelled");
  close();
}

TEST_F(RecordingWindow, ATerminatedRecordingIsASessionAllTheSame) {
  Person& person = start(with_model("mug"));
  person.see("pane.0.picture");
  person.wait_idle();
  record(3);
  program().signal(SIGTERM);
  expect_exit(130);
  ASSERT_EQ(sessions().size(), 1U);
  const fs::path session = sessions().front();
  EXPECT_GE(lines_of(session / "frames.csv"), 4U);
  EXPECT_EQ(contents_of(session / "frames.csv").back(), '\n');
  EXPECT_TRUE(contains(contents_of(session / "session.toml"), "complete"));
}

TEST_F(RecordingWindow, AKillLosesASecondAtMost) {
  Person& person = start({"mug", "--source", "simulated:rapl"});
  person.see("pane.0.picture");
  person.wait_idle();
  person.key("Ctrl+r");
  const WidgetMap map = person.wait_until(
      [](const WidgetMap& now) { return recorded(now).seconds >= 4.0; }, "four seconds");
  program().signal(SIGKILL);
  expect_exit(128 + SIGKILL);
  ASSERT_EQ(sessions().size(), 1U);
  // What is shown is rounded to whole seconds.
  EXPECT_GE(sampled_seconds(sessions().front()), recorded(map).seconds - 0.5 - 1.0);

  // The next start opens what is left.
  Person& next = start({"triangle"});
  next.see("pane.0.picture");
  next.choose({"menu.file", "menu.file.open_session"});
  enter_path(next, sessions().front());
  next.choose({"menu.measure", "menu.measure.sessions"});
  next.see_state("sessions.folder", sessions().front().string());
  EXPECT_NE(next.map().state("sessions.state"), "complete");
  next.look_calmly("cut-off-session");
  close();
}

}  // namespace encore::test
