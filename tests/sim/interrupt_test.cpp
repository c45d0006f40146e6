// A run that is interrupted ends in order: what was recorded is kept, and says that it is not whole.
#include <sys/wait.h>

#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>

#include "sim/interrupt.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Interrupt, ARunEndsInOrder) {
  const std::string program = DRYCUT_PROGRAM;
  if (!fs::exists(program)) GTEST_SKIP() << "needs the program, which is not built here";
  const TestFolder folder;
  const auto* text =
      "scene: {title: A web, step: 1 ms, duration: 100000 s}\nplants: {web: {type: web, speed: 60 m/min}}\n"
      "record: {every: 100 ms, channels: [web.position]}\nchecks: [{name: slow, always: web.speed <= 62}]\n";
  folder.file("first.yaml", text);
  folder.file("second.yaml", text);
  const auto out = folder / "out";
  const pid_t child =
      started(program, {"run", (folder / "first.yaml").string(), (folder / "second.yaml").string(),
                        "--no-pictures", "--quiet", "--out", out.string()});
  ASSERT_GT(child, 0);
  int status = 0;
  bool ended = false;
  const auto trace = out / "first/trace.csv";
  while (!ended && (!fs::exists(trace) || fs::file_size(trace) < 10'000))
    ended = waitpid(child, &status, WNOHANG) == child;
  ASSERT_FALSE(ended);
  kill(child, SIGINT);
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);

  const auto checks = nlohmann::json::parse(content(out / "first/checks.json"));
  EXPECT_FALSE(checks["passed"]);
  EXPECT_THAT(checks["failure"].get<std::string>(), HasSubstr("interrupted at "));
  EXPECT_LT(checks["end"], 100'000);
  // All that was simulated is there.
  const auto rows = content(trace);
  const auto last = rows.rfind('\n', rows.size() - 2) + 1;
  EXPECT_NEAR(std::stod(rows.substr(last)), checks["end"].get<double>(), 0.1);
  EXPECT_FALSE(fs::exists(out / "second/trace.csv"));
  const auto junit = content(out / "junit.xml");
  EXPECT_THAT(junit, HasSubstr("interrupted at "));
  EXPECT_THAT(junit, HasSubstr("not run: interrupted"));
}

TEST(Interrupt, IsWatchedUntilTheLastWatchHasEnded) {
  const auto watched = [] {
    auto first = std::make_unique<InterruptWatch>();
    const InterruptWatch last;
    first.reset();
    std::raise(SIGTERM);
    _exit(InterruptWatch::come() == SIGTERM ? 0 : 1);
  };
  EXPECT_EXIT(watched(), testing::ExitedWithCode(0), "");
  const auto over = [] {
    { const InterruptWatch watch; }
    std::raise(SIGTERM);
    _exit(0);
  };
  EXPECT_EXIT(over(), testing::KilledBySignal(SIGTERM), "");
  const auto another = [] {
    const InterruptWatch watch;
    std::raise(SIGINT);
    std::raise(SIGTERM);
    _exit(0);
  };
  EXPECT_EXIT(another(), testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace drycut::sim::cli
