// Work in a process of its own: what comes back, and what becomes of work that crashes, runs on or eats
// memory.
#include "renders/process.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <thread>

#include "tests/renders/renders_scratch.hpp"

namespace drycut::renders {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr WorkLimits roomy = {seconds(20), milliseconds(120'000), 512ULL << 20U, 1ULL << 20U};

std::string failure(const std::function<std::string()>& work, const WorkLimits& limits = roomy) {
  return message_of<WorkFailed>([&] { run_apart(work, limits); });
}

TEST(RendersApart, AnswersWithWhatTheWorkReturns) {
  std::string all;
  for (int i = 0; i < 1 << 20; ++i) all += static_cast<char>(i * 7 % 256);
  EXPECT_EQ(run_apart([&] { return all; }, roomy), all);
  EXPECT_EQ(run_apart([] { return std::string(); }, roomy), "");
}

TEST(RendersApart, NothingElseOfTheWorkIsSeen) {
  const Scratch scratch;
  std::ofstream half(scratch / "half");
  half << "once";  // not yet in the file
  int touched = 0;
  EXPECT_EQ(run_apart(
                [&] {
                  std::atexit([] { std::abort(); });
                  return std::to_string(++touched);
                },
                roomy),
            "1");
  EXPECT_EQ(touched, 0);
  half.close();
  EXPECT_EQ(content(scratch / "half"), "once");
}

TEST(RendersApart, WorksBesideOtherThreads) {
  std::vector<std::jthread> threads;
  std::array<std::string, 4> answers;
  for (std::size_t i = 0; i < answers.size(); ++i)
    threads.emplace_back([&, i] {
      answers[i] = run_apart([i] { return std::string(100'000, static_cast<char>('a' + i)); }, roomy);
    });
  threads.clear();
  for (std::size_t i = 0; i < answers.size(); ++i)
    EXPECT_EQ(answers[i], std::string(100'000, static_cast<char>('a' + i)));
}

TEST(RendersApart, ACrashAnAbortAndAnExceptionAreTold) {
  EXPECT_EQ(failure([]() -> std::string {
              raise(SIGSEGV);
              return "";
            }),
            "crashed (Segmentation fault)");
  EXPECT_EQ(failure([]() -> std::string { std::abort(); }), "crashed (Aborted)");
  EXPECT_EQ(failure([]() -> std::string { throw std::runtime_error("no"); }), "ended without an answer");
  EXPECT_EQ(failure([]() -> std::string { _exit(7); }), "ended without an answer");
}

TEST(RendersApart, WorkWithoutEndIsEnded) {
  WorkLimits short_of_time = roomy;
  short_of_time.computing = seconds(1);
  EXPECT_EQ(failure(
                []() -> std::string {
                  volatile bool on = true;
                  while (on) {
                  }
                  return "";
                },
                short_of_time),
            "took more than 1 s");
  WorkLimits impatient = roomy;
  impatient.until = milliseconds(50);
  EXPECT_EQ(failure(
                []() -> std::string {
                  for (;;) pause();
                },
                impatient),
            "took more than 0.05 s");
}

TEST(RendersApart, TooMuchMemoryAndTooLongAnAnswerAreTold) {
  EXPECT_EQ(failure([] { return std::string((1U << 20U) + 1, 'x'); }), "answered too much");
  if (!memory_is_limited) GTEST_SKIP() << "no limit of memory with AddressSanitizer";
  EXPECT_EQ(failure([] { return std::string(600U << 20U, 'x'); }), "took more than 512 MB of memory");
}

}  // namespace
}  // namespace drycut::renders
