#include "energy/session_csv.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

namespace encore::energy {
namespace {

using test::contents_of;
using test::TemporaryFolder;

const std::vector<KeyValue> kConfiguration{{"scene", "toys"}, {"structure", "kd-sah"}};

SessionColumns columns() {
  return {{"scene", "structure"}, {"nodes"}};
}

SessionInfo info_with_sources() {
  SessionInfo info;
  info.program = "encore";
  info.machine.compiler = "c++";
  info.machine.build_type = "Release";
  info.sensor = {Origin::measured, "RAPL"};
  info.plan = thesis_plan();
  info.plan.until = 0.01;
  info.plan.order = Order::abba;
  SessionSource source;
  source.info.name = "rapl:package-0";
  source.info.kind = SourceKind::rapl;
  source.info.domain = Domain::package;
  source.info.unit = "0";
  source.info.includes = "a package";
  source.info.place = "/sys/class/powercap";
  source.info.provenance = {Origin::measured, "RAPL"};
  source.info.energy_step = Joules(6.1035e-5);
  source.info.poll_period = Seconds(0.02);
  source.in_total = true;
  info.sources = {source, source};
  info.sources[1].info.name = "battery:BAT0";
  info.sources[1].info.kind = SourceKind::battery;
  info.sources[1].info.domain = Domain::system;
  info.sources[1].info.is_counter = false;
  info.sources[1].info.energy_step.reset();
  info.sources[1].info.power_step = Watts(0.01);
  info.sources[1].in_total = false;
  return info;
}

PhaseRow phase_row() {
  PhaseRow row;
  row.configuration = kConfiguration;
  row.source = "total";
  row.phase = "build";
  row.method = "regression";
  row.seconds = Seconds(1.5);
  row.operations = 12.25;
  row.watts = Watts(30.5);
  row.watts_ci95 = Watts(0.5);
  row.joules = Joules(2.0);
  row.joules_ci95 = Joules(0.1);
  row.origin = Origin::measured;
  row.note = "a note, with a comma";
  return row;
}

ConvergenceRow convergence_row() {
  ConvergenceRow row;
  row.configuration = kConfiguration;
  row.elapsed = Seconds(12.5);
  row.quantity = "watts";
  row.mean = 30.25;
  row.ci95 = 0.5;
  row.relative_ci95 = 0.0165;
  row.effective_samples = 38.5;
  return row;
}

void write_rows(SessionWriter& writer, double time) {
  writer.add(SampleRow{Seconds(time), "rapl:package-0", Watts(20), Joules(5), true, false,
                       Origin::measured});
  writer.add(EventRow{Seconds(time), "rapl:package-0", "the counter was reset"});
  writer.add(phase_row());
  writer.add(WindowRow{kConfiguration, "idle", Seconds(time), Seconds(time + 1)});
  writer.add(convergence_row());
}

TEST(SessionEnergy, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  {
    SessionWriter writer(folder.path(), info_with_sources(), columns());
    write_rows(writer, 1.5);
    writer.add(SampleRow{Seconds(2), "a", std::nullopt, Joules(1), false, true, Origin::simulated});
    writer.finish(SessionState::complete);
  }
  const Session session = read_session(folder.path());
  SessionInfo info = info_with_sources();
  info.state = SessionState::complete;
  EXPECT_EQ(session.info, info);
  ASSERT_EQ(session.samples.size(), 2U);
  EXPECT_EQ(session.samples[0].watts, Watts(20));
  EXPECT_FALSE(session.samples[1].watts);
  EXPECT_TRUE(session.samples[1].restarted);
  EXPECT_FALSE(session.samples[1].changed);
  ASSERT_EQ(session.phases.size(), 1U);
  EXPECT_EQ(session.phases[0], phase_row());
  ASSERT_EQ(session.convergence.size(), 1U);
  EXPECT_EQ(session.convergence[0], convergence_row());
  ASSERT_EQ(session.windows.size(), 1U);
  EXPECT_EQ(session.windows[0].kind, "idle");
  EXPECT_EQ(session.windows[0].to, Seconds(2.5));
  ASSERT_EQ(session.events.size(), 1U);
  EXPECT_EQ(session.events[0].message, "the counter was reset");
}

TEST(SessionEnergy, UnknownEnergyIsCalledUnavailable) {
  const CsvRecord record = to_record(phase_row());
  const CsvRecord header = phase_header(columns());
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (header[i] != "net_joules_per_operation") continue;
    EXPECT_EQ(record[i], kUnavailable);
  }
}

TEST(SessionEnergy, GoesOnWhereACrashCutItOff) {
  const TemporaryFolder folder;
  {
    SessionWriter writer(folder.path(), info_with_sources(), columns());
    write_rows(writer, 1.0);
  }
  // Half a row, as a crash leaves it.
  folder.write("samples.csv", contents_of(folder.path() / "samples.csv") + "2.5,rapl:pack");
  {
    SessionWriter writer(folder.path(), info_with_sources(), columns(), CsvWriter::Open::append);
    write_rows(writer, 3.0);
    writer.finish(SessionState::complete);
  }
  const Session session = read_session(folder.path());
  EXPECT_EQ(session.info.state, SessionState::complete);
  ASSERT_EQ(session.samples.size(), 2U);
  EXPECT_EQ(session.samples[0].time, Seconds(1.0));
  EXPECT_EQ(session.samples[1].time, Seconds(3.0));
  EXPECT_EQ(session.phases.size(), 2U);
}

TEST(SessionEnergy, DoesNotMixColumnsOfTwoVersions) {
  const TemporaryFolder folder;
  { SessionWriter writer(folder.path(), info_with_sources(), columns()); }
  const SessionColumns other{{"scene"}, {}};
  EXPECT_THROW(SessionWriter(folder.path(), info_with_sources(), other, CsvWriter::Open::append),
               SessionError);
}

}  // namespace
}  // namespace encore::energy
