#include "app/window/opened_session.h"
#include "app/window/recorder.h"
#include "recording_world.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <new>

namespace encore::app {
namespace {

namespace fs = std::filesystem;

/// What the recording process tells the one that kills it.
struct Shared {
  std::atomic<bool> recording{false};
  std::atomic<double> session_start{0.0};  ///< not later than that
  std::atomic<double> last_sample{0.0};    ///< of the steady clock, which all processes share
  std::atomic<double> last_row{0.0};
  std::atomic<bool> failed{false};
  std::atomic<bool> goes_on{false};
};

constexpr const char* kFolder = "ENCORE_TEST_RECORDING";

/// A page of a file that two processes see.
class SharedPage {
 public:
  explicit SharedPage(const fs::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor < 0 || ::ftruncate(descriptor, sizeof(Shared)) != 0) std::abort();
    memory_ = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    ::close(descriptor);
    if (memory_ == MAP_FAILED) std::abort();
  }
  ~SharedPage() { ::munmap(memory_, sizeof(Shared)); }
  SharedPage(const SharedPage&) = delete;
  SharedPage& operator=(const SharedPage&) = delete;
  Shared* operator->() { return static_cast<Shared*>(memory_); }

 private:
  void* memory_;
};

/// Runs one of the tests below that are disabled in a process of its own.
pid_t run_child(const char* test, const fs::path& folder) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::setenv(kFolder, folder.c_str(), 1);
  const std::string filter = std::string("--gtest_filter=RecorderChild.") + test;
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::execl("/proc/self/exe", "test_recording", filter.c_str(), "--gtest_also_run_disabled_tests",
          static_cast<char*>(nullptr));
  ::_exit(127);
}

/// Records a simulated sensor at 1 kHz, and short frames, until `ended`.
void record(SharedPage& shared, const fs::path& folder, const std::function<bool()>& ended) {
  const energy::SteadyClock clock;
  PowerMonitor monitor;
  MeasuringOptions options;
  options.sources = {"simulated:rapl"};
  options.poll = 0.001;
  monitor.choose(options);
  monitor.wait_until_open();
  LiveAttribution attribution(monitor);
  Recorder recorder(monitor, attribution);
  shared->session_start = clock.now().value;
  RecordingSetup setup;
  setup.folder = folder;
  recorder.start(setup);
  while (recorder.state().mode == RecorderMode::starting) std::this_thread::yield();
  const auto listener = monitor.listener(Device::cpu);
  energy::PhaseLog log(clock);
  log.tell(listener.get());
  attribution.slot_began(RecordingWorld::slot_of("cpu"));
  while (!ended()) {
    log.clear();
    const energy::Seconds began = attribution.begin_operation();
    {
      const auto mark = log.mark(energy::Phase::render);
      std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
    attribution.operation(log.spans(), began, clock.now());
    shared->last_row = began.value;
    for (const PowerNews::Points& one : monitor.drain().points) {
      shared->last_sample = monitor.start().value + one.points.back().time_s;
      shared->goes_on = shared->failed.load();
    }
    shared->failed = recorder.state().mode == RecorderMode::failed;
    shared->recording = recorder.state().samples > 0;
  }
  EXPECT_TRUE(recorder.state().mode != RecorderMode::failed ||
              recorder.state().message.find("cannot write") != std::string::npos);
}

/// No tests by themselves: what the ones below run and kill.
TEST(RecorderChild, DISABLED_RecordsUntilItIsKilled) {
  const char* folder = std::getenv(kFolder);
  ASSERT_NE(folder, nullptr);
  SharedPage shared(fs::path(folder) / "shared");
  record(shared, fs::path(folder) / "s", [] { return false; });
}

TEST(RecorderChild, DISABLED_RecordsUntilTheDiskIsFull) {
  const char* folder = std::getenv(kFolder);
  ASSERT_NE(folder, nullptr);
  SharedPage shared(fs::path(folder) / "shared");
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{40000, 40000};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  record(shared, fs::path(folder) / "s", [&] { return shared->goes_on.load(); });
}

TEST(KilledRecorder, LosesAtMostASecond) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> moment(100, 900);
  for (int run = 0; run < 3; ++run) {
    const TemporaryFolder folder;
    SharedPage shared(folder / "shared");
    const pid_t child = run_child("DISABLED_RecordsUntilItIsKilled", (folder / "").parent_path());
    ASSERT_GT(child, 0);
    ASSERT_TRUE(eventually([&] { return shared->recording.load(); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(moment(random)));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));

    TaskControl control;
    const OpenedSession opened = read_opened_session(folder / "s", control);
    EXPECT_TRUE(opened.cut_off);
    EXPECT_TRUE(opened.recomputed);
    EXPECT_EQ(opened.session.info.state, energy::SessionState::running);
    ASSERT_EQ(opened.series.size(), 1U);
    ASSERT_FALSE(opened.series[0].points.empty());
    ASSERT_FALSE(opened.session.frames.empty());
    const double start = shared->session_start;
    EXPECT_GT(start + opened.series[0].points.back().time_s, shared->last_sample - 1.0);
    EXPECT_GT(start + opened.session.frames.back().time.value, shared->last_row - 1.0);
    ASSERT_EQ(opened.bars.size(), 1U);
    EXPECT_GT(opened.bars[0].seconds.value, 0.004);
  }
}

TEST(FullDisk, EndsTheRecordingAndKeepsWhatWasWritten) {
  const TemporaryFolder folder;
  SharedPage shared(folder / "shared");
  const pid_t child = run_child("DISABLED_RecordsUntilTheDiskIsFull", (folder / "").parent_path());
  ASSERT_GT(child, 0);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);  // its own expectations: the message
  EXPECT_TRUE(shared->failed);
  EXPECT_TRUE(shared->goes_on);  // samples came in after that
  TaskControl control;
  const OpenedSession opened = read_opened_session(folder / "s", control);
  EXPECT_EQ(opened.session.info.state, energy::SessionState::failed);
  ASSERT_EQ(opened.series.size(), 1U);
  EXPECT_GT(opened.series[0].points.size(), 100U);
  EXPECT_FALSE(opened.session.frames.empty());
}

}  // namespace
}  // namespace encore::app
