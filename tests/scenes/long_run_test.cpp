// A run of any length: little memory, files that can be read while it runs and after it was killed, a report
// that a browser opens.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/test_folder.hpp"

namespace drycut::sim {
namespace {

namespace fs = std::filesystem;

const std::string scene = (fs::path(DRYCUT_SOURCE_DIR) / "scenes/rotary_knife.yaml").string();

/// The program, run on its own; its output is not looked at.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments) : pid_(fork()) {
    if (pid_ != 0) return;
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    arguments.insert(arguments.begin(), DRYCUT_PROGRAM);
    std::vector<char*> words;
    for (auto& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    execv(DRYCUT_PROGRAM, words.data());
    _exit(127);
  }
  ~Program() {
    if (!ended_) kill_and_wait();
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Its exit status.
  int wait() {
    int status = 0;
    wait4(pid_, &status, 0, &used_);
    ended_ = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void kill_and_wait() {
    kill(pid_, SIGKILL);
    wait();
  }
  [[nodiscard]] bool runs() {
    int status = 0;
    if (!ended_ && wait4(pid_, &status, WNOHANG, &used_) == pid_) ended_ = true;
    return !ended_;
  }
  /// The most memory that it ever held [kB].
  [[nodiscard]] long peak() const { return used_.ru_maxrss; }

 private:
  pid_t pid_;
  bool ended_ = false;
  rusage used_ = {};
};

long peak_of(const std::string& duration, const fs::path& out, bool pictures) {
  std::vector<std::string> arguments = {"run",   scene,       "--set", "scene.duration=" + duration,
                                        "--out", out.string()};
  if (pictures)
    arguments.insert(arguments.end(), {"--set", "pictures.frames.until=100 ms"});
  else
    arguments.emplace_back("--no-pictures");
  Program program(arguments);
  EXPECT_EQ(program.wait(), 0);
  return program.peak();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(LongRun, TakesNoMoreMemoryThanAShortOne) {
  const TestFolder out;
  const long of_short = peak_of("30 s", out.path, false);
  const long of_long = peak_of("330 s", out.path, false);
  // The twelve channels of 300 s more are 15 MB.
  EXPECT_LT(of_long - of_short, 3000) << "kB";
  const auto lines = lines_of(content(out / "rotary_knife/trace.csv"));
  EXPECT_EQ(lines.size(), 1 + 330 * 500 + 1U);
}

TEST(LongRun, ReportIsThinnedAndSaysSo) {
  const TestFolder out;
  const long of_short = peak_of("30 s", out.path, true);
  const long of_long = peak_of("330 s", out.path, true);
  EXPECT_LT(of_long - of_short, 40000) << "kB";
  const auto report = content(out / "rotary_knife/report.html");
  EXPECT_LT(report.size(), 8U << 20U);
  const auto tells = [&](const char* words) { return report.find(words) != std::string::npos; };
  EXPECT_TRUE(tells("165001 samples of each channel: what the plots show is thinned"));
  EXPECT_TRUE(tells("thinned: the lowest and the highest of 17 samples, 0.034 s"));
}

TEST(LongRun, KilledAtAnyMomentLeavesWholeRows) {
  const TestFolder out;
  for (const std::size_t size : {1000U, 200'000U, 3'000'000U}) {
    const auto trace = out / "rotary_knife/trace.csv";
    fs::remove(trace);
    Program program(
        {"run", scene, "--set", "scene.duration=1e7 s", "--no-pictures", "--out", out.path.string()});
    std::error_code ignored;
    while (program.runs() && !(fs::exists(trace) && fs::file_size(trace, ignored) > size)) sched_yield();
    program.kill_and_wait();
    auto text = content(trace);
    ASSERT_GT(text.size(), size);
    // The kernel may stop in the midst of a write; all before it is whole.
    text.resize(text.rfind('\n') + 1);
    const auto lines = lines_of(text);
    double last = -1;
    for (const auto& line : lines) {
      ASSERT_EQ(std::count(line.begin(), line.end(), ','), 12) << line;
      if (&line == &lines.front()) continue;
      ASSERT_GT(std::stod(line), last) << line;
      last = std::stod(line);
    }
    EXPECT_NEAR(last, 0.002 * static_cast<double>(lines.size() - 2), 1e-9);
  }
}

}  // namespace
}  // namespace drycut::sim
