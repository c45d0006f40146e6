#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace drycut::devices {

// Tests of programs in the programs' own language, without a machine.

/// An assertion that did not hold, or an error that ended a test.
struct TestFailure {
  std::string file;
  int line = 0;
  std::string text;      ///< its message, or the error's; "" = none
  std::string expected;  ///< "" = nothing is compared
  std::string actual;
};
/// "expected 5, was 4: too slow".
std::string to_string(const TestFailure& failure);

/// What a test says as it goes.
struct TestLog {
  static constexpr std::size_t most_failures = 20;  ///< that are kept

  std::string title = {};                  ///< that it gives itself: TEST('...')
  std::vector<TestFailure> failures = {};  ///< the first of them
  std::size_t failed = 0;                  ///< all
  int assertions = 0;
  bool finished = false;

  void add(TestFailure failure);
};

/// What came of a test.
struct TestResult {
  std::string name;  ///< "TEST_Ramp", of a method "RampTests.TEST_Down"
  std::string file;
  int line = 0;
  TestLog log = {};
  std::int64_t took_ns = 0;  ///< of simulated time
  [[nodiscard]] bool passed() const { return log.failures.empty(); }
};

/// How tests run.
struct TestTimes {
  std::int64_t cycle_ns = 1'000'000;         ///< a scan, or a round of tasks, begins so often
  std::int64_t timeout_ns = 10'000'000'000;  ///< a test that goes on longer has failed
};
/// Of a test that has not come to its end by then.
TestFailure not_finished(const TestResult& result, const TestTimes& times, const std::string& remedy);

}  // namespace drycut::devices
