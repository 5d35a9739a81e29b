#include "app/doctor.h"

#include "profile_json_check.h"
#include "run_program.h"
#include "tests/support/fake_clock.h"
#include "tests/support/files.h"
#include "tests/support/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

namespace encore::app {
namespace {

using energy::Domain;
using energy::Finding;
using energy::Reading;
using energy::ReadResult;
using energy::ReadState;
using energy::Seconds;
using energy::SourceInfo;
using energy::SourceKind;
using energy::Watts;
using test::contains;

/// A sensor whose value is a function of time, seen every `period`.
class FakeSource final : public energy::PowerSource {
 public:
  using Answer = std::function<ReadResult(Seconds since_start)>;
  FakeSource(SourceInfo info, Answer answer) : info_(std::move(info)), answer_(std::move(answer)) {}
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  ReadResult read(Seconds now) override {
    ReadResult result = answer_(now - Seconds(1000));
    result.reading.time = now;
    const double shown =
        result.reading.power ? result.reading.power->value : result.reading.energy.value;
    result.reading.changed = !last_ || shown != *last_;
    last_ = shown;
    return result;
  }

 private:
  SourceInfo info_;
  Answer answer_;
  std::optional<double> last_;  ///< what the sensor showed
};

ReadResult joules(double energy) {
  ReadResult result;
  result.state = ReadState::ok;
  result.reading.energy = energy::Joules(energy);
  return result;
}

/// A counter of `watts` that moves every `period` seconds.
FakeSource::Answer counter(double watts, double period) {
  return [=](Seconds t) { return joules(watts * period * std::floor(t.value / period + 1e-6)); };
}

Finding finding(const std::string& name, Domain domain, const FakeSource::Answer& answer) {
  Finding found;
  found.info.name = name;
  found.info.kind = SourceKind::rapl;
  found.info.domain = domain;
  found.info.unit = "0";
  found.open = [info = found.info, answer] { return std::make_unique<FakeSource>(info, answer); };
  return found;
}

DoctorReport examined(const std::vector<Finding>& findings, bool all = false) {
  const energy::FakeClock clock;
  const std::atomic<bool> stop = false;
  // Never suspended, however slowly the test runs.
  return examine({}, findings, {Seconds(2.0), all, [&] { return clock.now(); }}, clock, stop);
}

TEST(Doctor, SeesPeriodsFarBelowThePaceOfReading) {
  const DoctorReport report =
      examined({finding("rapl:package-0", Domain::package, counter(20, 0.001))});
  const SensorReport& sensor = report.sensors.at(0);
  ASSERT_TRUE(sensor.period);
  EXPECT_NEAR(sensor.period->median.value, 0.001, 1e-5);
  EXPECT_FALSE(sensor.period_is_bound);
  EXPECT_NEAR(sensor.mean.value().value, 20.0, 0.05);
  EXPECT_TRUE(sensor.notes.empty());
  EXPECT_EQ(report.total, std::vector<std::size_t>{0});
  EXPECT_NEAR(report.total_mean.value().value, 20.0, 0.05);
}

TEST(Doctor, PeriodsBelowThePaceOfReadingAreBounds) {
  Finding slow = finding("hwmon:x", Domain::gpu, counter(20, 0.01));
  slow.info.update_period = Seconds(0.1);
  slow.info.poll_period = Seconds(0.05);
  slow.open = [info = slow.info] { return std::make_unique<FakeSource>(info, counter(20, 0.01)); };
  const DoctorReport report = examined({slow});
  ASSERT_TRUE(report.sensors[0].period);
  EXPECT_TRUE(report.sensors[0].period_is_bound);
  EXPECT_TRUE(contains(doctor_text(report), "≤ 50 ms")) << doctor_text(report);
}

TEST(Doctor, ACounterThatStandsStillHasNoWatts) {
  const DoctorReport report =
      examined({finding("rapl:package-0", Domain::package, [](Seconds) { return joules(0); })});
  const SensorReport& sensor = report.sensors.at(0);
  EXPECT_FALSE(sensor.obstacle);
  EXPECT_FALSE(sensor.mean);
  EXPECT_FALSE(report.total_mean);
  ASSERT_EQ(sensor.notes.size(), 1U);
  EXPECT_EQ(sensor.notes[0], "no change seen in 2 s: no watts");
  EXPECT_FALSE(contains(doctor_text(report), "0.00 W")) << doctor_text(report);
  EXPECT_TRUE(contains(doctor_json(report), "\"mean_w\": null"));
}

TEST(Doctor, AGaugeThatStandsStillKeepsItsWattsAndSaysSo) {
  Finding gauge = finding("battery:BAT0", Domain::system, {});
  gauge.info.is_counter = false;
  gauge.info.update_period = Seconds(4.0);
  gauge.open = [info = gauge.info] {
    return std::make_unique<FakeSource>(info, [](Seconds t) {
      ReadResult result = joules(15 * t.value);
      result.reading.power = Watts(15);
      return result;
    });
  };
  const DoctorReport report = examined({gauge});
  EXPECT_NEAR(report.sensors[0].mean.value().value, 15.0, 1e-9);
  EXPECT_EQ(report.sensors[0].notes, std::vector<std::string>{"no change seen in 2 s"});
}

TEST(Doctor, ASensorThatNeverAnswersIsNotUsable) {
  const auto dead = [](Seconds) {
    ReadResult result;
    result.state = ReadState::failed;
    result.message = "/sys/x: input/output error";
    return result;
  };
  const DoctorReport report = examined({finding("rapl:package-0", Domain::package, dead)});
  EXPECT_FALSE(report.any_usable());
  EXPECT_EQ(report.sensors[0].obstacle.value().reason, "/sys/x: input/output error");
  EXPECT_TRUE(report.total.empty());
}

TEST(Doctor, ASensorThatDoesNotOpenIsNotUsable) {
  Finding gone = finding("rapl:package-0", Domain::package, {});
  gone.open = []() -> std::unique_ptr<energy::PowerSource> {
    throw energy::SensorError("it has gone");
  };
  const DoctorReport report = examined({gone});
  EXPECT_FALSE(report.any_usable());
  EXPECT_TRUE(contains(doctor_text(report), "it has gone"));
}

TEST(Doctor, GapsAreToldAndLeftOutOfTheMean) {
  const auto with_gap = [](Seconds t) {
    ReadResult result = joules(10 * t.value);
    if (t > Seconds(0.8) && t < Seconds(0.9)) {
      result.state = ReadState::restarted;
      result.message = "the counter was reset";
    }
    return result;
  };
  const DoctorReport report = examined({finding("rapl:package-0", Domain::package, with_gap)});
  EXPECT_NEAR(report.sensors[0].mean.value().value, 10.0, 1e-6);
  EXPECT_EQ(report.sensors[0].notes, std::vector<std::string>{"the counter was reset"});
}

TEST(Doctor, SetAsideSensorsAreReadOnlyIfThatIsHarmlessOrAskedFor) {
  int opened = 0;
  Finding asleep = finding("nvml:0", Domain::gpu, {});
  asleep.info.kind = SourceKind::nvml;
  asleep.set_aside = "the GPU is asleep; reading would wake it";
  asleep.open = [&opened, info = asleep.info] {
    ++opened;
    return std::make_unique<FakeSource>(info, counter(10, 0.02));
  };
  Finding nested = finding("rapl:package-0/core", Domain::cores, counter(5, 0.001));
  nested.set_aside = "part of rapl:package-0";
  const DoctorReport report = examined({asleep, nested});
  EXPECT_EQ(opened, 0);
  EXPECT_FALSE(report.sensors[0].mean);
  EXPECT_TRUE(report.sensors[1].mean);
  EXPECT_TRUE(report.total.empty());
  EXPECT_TRUE(report.any_usable());
  EXPECT_TRUE(contains(doctor_text(report), "all usable sensors are set aside"));
  EXPECT_TRUE(examined({asleep, nested}, true).sensors[0].mean);
  EXPECT_EQ(opened, 1);
}

TEST(Doctor, APlatformBelowItsPackageIsNotValid) {
  const DoctorReport report =
      examined({finding("rapl:package-0", Domain::package, counter(20, 0.001)),
                finding("rapl:psys", Domain::platform, counter(3, 0.001))});
  ASSERT_EQ(report.sensors[1].notes.size(), 1U);
  EXPECT_TRUE(contains(report.sensors[1].notes[0], "not valid")) << report.sensors[1].notes[0];
  EXPECT_EQ(report.total, std::vector<std::size_t>{0});
}

energy::TraceView trace(const std::vector<energy::TracePoint>& points) {
  return energy::TraceView(points);
}

TEST(Doctor, MeanPowerOfACounterRunsFromChangeToChange) {
  SourceInfo info;
  info.update_period = Seconds(0.1);
  const auto at = [](double time, double energy, bool changed, bool starts = false) {
    return energy::TracePoint{Seconds(time), energy::Joules(energy), {}, changed, starts};
  };
  // 2 J each 0.4 s are 5 W; what lies before the first change and behind the last is unknown.
  EXPECT_DOUBLE_EQ(mean_power(trace({at(0, 0, true, true), at(0.3, 1, true), at(0.5, 1, false),
                                     at(0.7, 3, true), at(9, 3, false)}),
                              info)
                       .value()
                       .value,
                   5.0);
  // Two updates within less than two periods tell no watts, one tells none at all.
  EXPECT_FALSE(
      mean_power(trace({at(0, 0, true, true), at(0.3, 1, true), at(0.45, 3, true)}), info));
  EXPECT_FALSE(mean_power(trace({at(0, 0, true, true), at(0.3, 1, true)}), info));
  EXPECT_FALSE(mean_power(trace({}), info));
}

std::string tree(const std::string& name) {
  return std::filesystem::path(ENCORE_FIXTURES) / "sysfs" / name;
}

ProgramResult doctor(const std::string& root, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"doctor", "--sysfs-root", root, "--seconds", "0.1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_encore(arguments);
}

TEST(DoctorCommand, NamesSensorsWhatTheyIncludeAndWhatIsSummed) {
  const ProgramResult result = doctor(tree("rapl_2pkg_dram"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* text :
       {"rapl:package-0", "rapl:package-1/dram", "memory modules at processor package 1",
        "/sys/class/powercap/intel-rapl:1/energy_uj", "no change seen in",
        "rapl:package-0 + rapl:package-0/dram + rapl:package-1 + rapl:package-1/dram",
        "no hypervisor", "cost of reading", "/sys/class/power_supply", "/sys/class/hwmon"}) {
    EXPECT_TRUE(contains(result.out, text)) << text << "\n" << result.out;
  }
  EXPECT_FALSE(contains(result.out, "0.00 W")) << result.out;
  EXPECT_EQ(result.err, "");
}

TEST(DoctorCommand, ExitsWithFourWhereNothingCanBeUsedAndSaysWhy) {
  const ProgramResult result = doctor(tree("powercap_empty"));
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_TRUE(contains(result.out, "virtual machine")) << result.out;
  EXPECT_TRUE(contains(result.out, "no sensor can be used")) << result.out;
  EXPECT_FALSE(contains(result.out, " 0.00 W")) << result.out;
}

TEST(DoctorCommand, JsonIsJsonAndTellsTheSame) {
  for (const char* name : {"rapl_1pkg_psys_mmio", "powercap_empty", "perf_2pkg"}) {
    const ProgramResult result = doctor(tree(name), {"--json"});
    EXPECT_TRUE(JsonChecker(result.out).valid()) << result.out;
    EXPECT_TRUE(contains(result.out, "\"mean_w\": null")) << result.out;
  }
  const ProgramResult client = doctor(tree("rapl_1pkg_psys_mmio"), {"--json"});
  EXPECT_TRUE(contains(client.out, "\"total\": {\"sources\": [\"rapl:package-0\"]")) << client.out;
  EXPECT_TRUE(contains(client.out, "\"virtual_machine\": false")) << client.out;
  EXPECT_TRUE(contains(client.out, "repeats rapl:package-0 (intel-rapl:0)")) << client.out;
}

TEST(DoctorCommand, MisuseExitsWithTwo) {
  EXPECT_EQ(run_encore({"doctor", "--sysfs-root", "no/such/folder"}).exit_code, 2);
  EXPECT_EQ(run_encore({"doctor", "--seconds", "0"}).exit_code, 2);
}

TEST(DoctorCommand, HelpTellsTheExitCodes) {
  const ProgramResult help = run_encore({"doctor", "--help"});
  EXPECT_TRUE(contains(help.out, "4 none can")) << help.out;
  EXPECT_TRUE(contains(run_encore({"--help"}).out, "4 no usable power sensor"));
}

}  // namespace
}  // namespace encore::app
