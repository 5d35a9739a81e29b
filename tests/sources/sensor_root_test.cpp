#include "energy/sources/sensor_root.h"

#include "energy/sources/host.h"
#include "fixture_tree.h"

#include <cerrno>

namespace encore::energy {
namespace {

TEST(SensorRoot, PathsLieBelowTheRootAndAreShownWithoutIt) {
  const SensorRoot root("/some/copy");
  EXPECT_EQ(root.resolve("/sys/class/hwmon"), "/some/copy/sys/class/hwmon");
  EXPECT_EQ(root.shown("/some/copy/sys/class/hwmon"), "/sys/class/hwmon");
  EXPECT_FALSE(root.is_real());
  EXPECT_TRUE(SensorRoot().is_real());
  EXPECT_EQ(SensorRoot().shown("/sys/class"), "/sys/class");
  EXPECT_EQ(SensorRoot().resolve("/sys"), "/sys");
}

TEST(SensorRoot, FoldersAreListedInNaturalOrder) {
  const test::TemporaryFolder folder;
  for (const char* name : {"hwmon10", "hwmon2", "hwmon1", "a", "hwmon2x"}) {
    folder.write(std::string("sys/") + name, "");
  }
  EXPECT_EQ(SensorRoot(folder.path()).list("/sys"),
            (std::vector<std::string>{"a", "hwmon1", "hwmon2", "hwmon2x", "hwmon10"}));
  EXPECT_TRUE(SensorRoot(folder.path()).list("/proc").empty());
}

TEST(SensorRoot, FilesLoseTheirLineBreakAndNothingElse) {
  const test::TemporaryFolder folder;
  folder.write("value", " 12 \n\n");
  folder.write("empty", "");
  const SensorRoot root(folder.path());
  EXPECT_EQ(root.read("/value").text, " 12");
  EXPECT_EQ(root.read("/empty").text, "");
  EXPECT_EQ(root.read("/value").error, 0);
}

TEST(SensorRoot, MissingFilesAndFoldersTellWhy) {
  const test::TemporaryFolder folder;
  folder.write("file", "1");
  const SensorRoot root(folder.path());
  EXPECT_FALSE(root.read("/none").text);
  EXPECT_EQ(root.read("/none").error, ENOENT);
  EXPECT_FALSE(root.read("/").text);
  EXPECT_EQ(root.read("/").error, EISDIR);
  EXPECT_EQ(describe_error(root.resolve("/none"), ENOENT), "no such file or directory");
}

TEST(SensorRoot, DeniedFilesTellTheirMode) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("energy_uj", "1");
  std::filesystem::permissions(file, std::filesystem::perms(0400));
  EXPECT_TRUE(has_text(describe_error(file, EACCES), "permission denied (mode 0400, owner "))
      << describe_error(file, EACCES);
}

TEST(SensorRoot, HugeFilesAreCut) {
  const test::TemporaryFolder folder;
  folder.write("huge", std::string(1'000'000, 'x'));
  EXPECT_LE(SensorRoot(folder.path()).read("/huge").text->size(), 70'000U);
}

TEST(SensorRoot, NumbersAreWholeOrNothing) {
  EXPECT_EQ(parse_unsigned("18446744073709551615"), 18446744073709551615U);
  EXPECT_EQ(parse_integer("-386000"), -386000);
  EXPECT_EQ(parse_integer("-9223372036854775808"), INT64_MIN);
  for (const char* text : {"", " 1", "1 ", "1.5", "0x10", "+1", "N/A", "18446744073709551616"}) {
    EXPECT_FALSE(parse_unsigned(text)) << text;
    EXPECT_FALSE(parse_integer(text)) << text;
  }
  EXPECT_FALSE(parse_unsigned("-1"));
}

TEST(Host, ProcessorFlagsAreWholeWords) {
  const ChangingTree tree("powercap_empty");
  EXPECT_TRUE(is_virtual_machine(tree.root()));
  EXPECT_FALSE(read_host(tree.root()).amd);
  tree.set("proc/cpuinfo", "vendor_id\t: HygonGenuine\nflags\t\t: sgx_lc hypervisors");
  const Host host = read_host(tree.root());
  EXPECT_TRUE(host.amd);
  EXPECT_FALSE(host.sgx);
  EXPECT_FALSE(host.virtual_machine.value());
  EXPECT_FALSE(is_virtual_machine(tree.root()));
}

TEST(Host, WithoutProcessorFileNothingIsClaimed) {
  const test::TemporaryFolder folder;
  const Host host = read_host(SensorRoot(folder.path()));
  EXPECT_FALSE(host.amd || host.sgx || host.container || host.virtual_machine);
  EXPECT_EQ(why_no_counters(host), "");
}

TEST(Host, ContainersAreKnownByTheirMarks) {
  const test::TemporaryFolder folder;
  folder.write("proc/1/cgroup", "12:cpu:/kubepods/burstable/pod1\n");
  EXPECT_TRUE(read_host(SensorRoot(folder.path())).container);
}

}  // namespace
}  // namespace encore::energy
