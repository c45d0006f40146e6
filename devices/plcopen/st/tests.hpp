#pragma once
#include <vector>

#include "devices/coverage.hpp"
#include "devices/plcopen/st/program.hpp"
#include "devices/program_test.hpp"

namespace drycut::devices::plcopen::st {

// Tests in Structured Text, after TcUnit. A FUNCTION_BLOCK or PROGRAM whose name begins with TEST_ is one, or
// each of its METHODs with such a name; such METHODs of other blocks are tests, too. A test begins with
// initial values and no axis, and is called once; one that mentions TEST_FINISHED is called each cycle,
// simulated time going on, until it calls that.
//
// AssertTrue(Condition, Message), AssertFalse, AssertEquals(Expected, Actual, Message) of any elementary type
// and of texts, AssertEquals(Expected, Actual, Delta, Message) of real numbers, AssertEquals_INT and its
// like, by order or by name; Message may be left out. TEST('title') says what is tested.

/// Runs all tests of a program that was compiled with CompileOptions::tests, in the order of the text. What
/// their code runs is added to `coverage`, if there is one.
std::vector<TestResult> run_tests(const Program& program, const TestTimes& times, Coverage* coverage);

}  // namespace drycut::devices::plcopen::st
