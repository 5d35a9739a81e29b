#include "app/window/doctor_view.h"

#include "recording_world.h"

#include <gtest/gtest.h>

namespace encore::app {
namespace {

TEST(DoctorView, NamesWhatIsInTheWayAndTheWayOut) {
  DoctorReport report;
  report.host.virtual_machine = true;
  report.host.container = true;
  SensorReport usable;
  usable.info.name = "rapl:package-0";
  usable.mean = energy::Watts(12.5);
  SensorReport obstructed;
  obstructed.info.name = "rapl:dram-0";
  obstructed.obstacle = energy::Obstacle{"permission denied", "sudo chmod a+r energy_uj"};
  SensorReport aside;
  aside.info.name = "hwmon:a";
  aside.set_aside = "it repeats rapl:package-0";
  report.sensors = {usable, obstructed, aside};
  report.total = {0};
  const DoctorFindings findings = findings_of(report);
  ASSERT_EQ(findings.sensors.size(), 3U);
  EXPECT_EQ(findings.sensors[0].state, "usable");
  EXPECT_TRUE(findings.sensors[0].usable && findings.sensors[0].in_total);
  EXPECT_EQ(findings.sensors[0].watts, 12.5);
  EXPECT_FALSE(findings.sensors[0].period_s);
  EXPECT_EQ(findings.sensors[1].state, "not usable");
  EXPECT_EQ(findings.sensors[1].reason, "permission denied");
  EXPECT_EQ(findings.sensors[1].way_out, "sudo chmod a+r energy_uj");
  EXPECT_FALSE(findings.sensors[1].watts);
  EXPECT_EQ(findings.sensors[2].state, "set aside");
  EXPECT_TRUE(findings.sensors[2].usable);
  EXPECT_FALSE(findings.total_watts);
  EXPECT_NE(findings.host.find("virtual machine"), std::string::npos);
  EXPECT_NE(findings.host.find("container"), std::string::npos);
  EXPECT_EQ(findings.advice, "");
}

TEST(DoctorView, LooksInTheBackgroundAndCanBeStopped) {
  const TemporaryFolder empty;
  DoctorRequest request;
  request.sensor_root = (empty / "").string();
  request.length = energy::Seconds(0.05);
  DoctorTask task;
  task.start([request](TaskControl& control) { return examine_for_window(request, control); });
  const auto result = task.wait();
  ASSERT_TRUE(result.value) << result.error;
  EXPECT_FALSE(result.value->sensors.empty());  // each kind that is absent has its word
  EXPECT_EQ(result.value->any_usable, result.value->advice.empty());
  task.start([request](TaskControl& control) {
    control.stop = true;
    return examine_for_window(request, control);
  });
  EXPECT_TRUE(task.wait().cancelled);
}

TEST(BackgroundTask, TellsAnErrorAndIsDoneOnce) {
  BackgroundTask<int> task;
  EXPECT_FALSE(task.running());
  task.start([](TaskControl&) -> int { throw std::runtime_error("no such thing"); });
  ASSERT_TRUE(eventually([&] { return !task.running(); }));
  const auto result = task.take();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->error, "no such thing");
  EXPECT_FALSE(result->value);
  EXPECT_FALSE(task.take());
}

TEST(BackgroundTask, ANewOneTakesThePlaceOfOneThatStillEnds) {
  std::atomic<bool> may_end{false};  // outlives the thread that looks at it
  BackgroundTask<int> task;
  task.start([&](TaskControl&) {
    while (!may_end) std::this_thread::yield();
    return 1;
  });
  task.start([](TaskControl&) { return 2; });
  EXPECT_EQ(task.wait().value, 2);
  may_end = true;
}

}  // namespace
}  // namespace encore::app
