#include "devices/plcopen/st/tests.hpp"

#include <fmt/format.h>

#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/coverage.hpp"
#include "devices/plcopen/st/machine.hpp"

namespace drycut::devices::plcopen::st {
namespace {

TestResult run_test(const Program& program, const Compiled::Test& test, const TestTimes& times,
                    Counts* counts) {
  const Compiled& code = program.compiled();
  const auto place = code.lines.at(test.line);
  TestResult result{test.name, code.files[place.file].name, place.line};
  MotionKernel kernel;
  Machine machine(code, kernel);
  Trace trace{{}, nullptr, counts};
  TestLog& log = result.log;
  machine.start(true);
  machine.log_tests(&log);
  if (counts != nullptr) machine.trace(&trace);
  try {
    for (;; result.took_ns += times.cycle_ns) {
      if (result.took_ns > times.timeout_ns) {
        log.add(not_finished(result, times, "it calls TEST_FINISHED at its end"));
        break;
      }
      machine.run(test, result.took_ns);
      if (!test.finishes || log.finished) break;
    }
  } catch (const StError& error) {
    const auto at = code.lines.at(error.line);
    log.add({code.files[at.file].name, at.line, error.what(), "", ""});
  }
  return result;
}

}  // namespace

std::vector<TestResult> run_tests(const Program& program, const TestTimes& times, Coverage* coverage) {
  const Compiled& code = program.compiled();
  Counts counts(coverage != nullptr ? code.code.size() : 0);
  std::vector<TestResult> results;
  for (const Compiled::Test& test : code.tests)
    results.push_back(run_test(program, test, times, coverage != nullptr ? &counts : nullptr));
  if (coverage != nullptr) {
    std::vector<std::string> files;
    for (const auto& file : code.files) files.push_back(file.name);
    coverage->add(coverage_of(code, counts, files));
  }
  return results;
}

}  // namespace drycut::devices::plcopen::st
