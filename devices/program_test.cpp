#include "devices/program_test.hpp"

#include <fmt/format.h>

#include <utility>

namespace drycut::devices {

void TestLog::add(TestFailure failure) {
  if (++failed <= most_failures) failures.push_back(std::move(failure));
}

std::string to_string(const TestFailure& failure) {
  if (failure.expected.empty()) return failure.text;
  return fmt::format("expected {}, was {}{}{}", failure.expected, failure.actual,
                     failure.text.empty() ? "" : ": ", failure.text);
}

TestFailure not_finished(const TestResult& result, const TestTimes& times, const std::string& remedy) {
  return {result.file, result.line,
          fmt::format("it has not come to its end within {:g} s; {}",
                      static_cast<double>(times.timeout_ns) / 1e9, remedy),
          "", ""};
}

}  // namespace drycut::devices
