#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/coverage.hpp"
#include "devices/program_test.hpp"
#include "devices/qmove/program.hpp"

namespace drycut::devices::qmove {

// Tests in QCL. A SUB whose name begins with TEST_ is one, and what it asserts stands in comments, so that
// the module runs on a controller as it is:
//
//   SUB TEST_Length
//     glLength = 500
//     CALL Limit
//     ; ASSERT glLength LE glMax
//   ENDSUB
//
// A test is the only thing that its module does; modules without tests run beside it, as the tasks that they
// are, on one controller without a machine. WAIT and timers see simulated time. The first assertion that does
// not hold ends the test.

/// Runs all tests of modules that were compiled with `tests`, in their order. `configuration` is free of
/// problems. What their code runs is added to `coverage`, if there is one.
std::vector<TestResult> run_tests(const Configuration& configuration, std::span<const QclProgram> modules,
                                  std::span<const CatalogueEntry> catalogue, const TestTimes& times,
                                  Coverage* coverage);

/// What the counts of a module's instructions say of its text.
Coverage coverage_of(const QclProgram& program, const Counts& counts);

}  // namespace drycut::devices::qmove
