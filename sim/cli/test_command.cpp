#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "devices/plcopen/st/tests.hpp"
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/tests.hpp"
#include "sim/cli/annotations.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/file_kinds.hpp"
#include "sim/cli/paint.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/report/coverage.hpp"
#include "sim/report/results.hpp"
#include "sim/scenario/archive.hpp"

namespace drycut::sim::cli {

namespace {

namespace qmove = devices::qmove;
namespace st = devices::plcopen::st;

struct TestOptions {
  std::vector<std::filesystem::path> files;
  std::string cycle = "1 ms";
  std::string timeout = "10 s";
  std::string dialect = {};             ///< of Structured Text; "" = CODESYS's
  std::filesystem::path junit = {};     ///< "" = none
  std::filesystem::path coverage = {};  ///< "" = nothing is counted
  bool force = false;
  std::string annotate = {};
};

/// Any XML file begins as one of ours does; the second line is ours alone.
bool is_own_junit(const std::filesystem::path& file) {
  Problems ignored;
  const auto text = file_exists(file) ? read_file(file, ignored) : std::nullopt;
  return text && text->find("<testsuites name=\"drycut\">") < 100;
}

/// The programs that the command line names, compiled.
struct Programs {
  std::vector<SourceFile> texts;  ///< of Structured Text: one program
  std::optional<st::Program> program;
  std::optional<qmove::Configuration> configuration;
  std::vector<qmove::QclProgram> modules;

  /// What is no fault of theirs and worth knowing.
  [[nodiscard]] std::vector<Finding> notes() const {
    auto all = program ? program->notes() : std::vector<Finding>();
    for (const auto& module : modules) all.insert(all.end(), module.notes.begin(), module.notes.end());
    return all;
  }
};

Time read_span_of(const std::string& text, const char* option, Problems& problems) {
  scenario::Findings findings({option});
  const auto time = scenario::read_time({text, {1, 1, 0}, {}}, option, scenario::Sign::positive, findings);
  for (auto& problem : findings.sorted()) problems.push_back(std::move(problem));
  return time.value_or(1);
}

std::optional<st::StDialect> dialect_of(const std::string& name) {
  const auto known = std::find(st::dialect_names.begin(), st::dialect_names.end(), name);
  if (known == st::dialect_names.end()) return std::nullopt;
  return static_cast<st::StDialect>(known - st::dialect_names.begin());
}

Programs compile_all(const TestOptions& options, Problems& problems) {
  const auto& files = options.files;
  Programs all;
  for (const auto& file : files) {
    const auto kind = kind_of(file);
    if (kind == FileKind::structured_text) {
      for (const auto& one : folder_exists(file) ? files_in(file, ".st") : std::vector{file})
        if (auto text = read_file(one, problems)) all.texts.push_back({one.string(), std::move(*text)});
    } else if (kind == FileKind::configuration) {
      if (all.configuration)
        problems.push_back({"option.together"_code, file.string(), 1, 1, "a second configuration",
                            "one .cnf and its modules at a time"});
      else if (const auto text = read_file(file, problems))
        all.configuration = qmove::parse_configuration(*text, file.string(), devices::catalogue(), problems);
    } else if (kind != FileKind::module) {
      problems.push_back({"file.other-kind"_code, file.string(), 1, 1, "its language has no tests",
                          "Structured Text and QCL have; check an instruction list in a scenario"});
    }
  }
  for (const auto& file : files) {
    if (kind_of(file) != FileKind::module || !problems.empty()) continue;
    if (!all.configuration)
      problems.push_back({"qcl.no-configuration"_code, file.string(), 1, 1,
                          "a QCL module needs a configuration to be tested with", "name its .cnf, too"});
    else if (const auto text = read_file(file, problems))
      all.modules.push_back(qmove::compile_module(*text, file.string(), *all.configuration,
                                                  devices::catalogue(), problems, true));
  }
  if (!all.texts.empty() && problems.empty()) {
    const st::CompileOptions tests{.tests = true, .dialect = dialect_of(options.dialect)};
    all.program = st::compile(all.texts, tests, problems);
  }
  return all;
}

std::vector<devices::TestResult> run_all(const Programs& all, const devices::TestTimes& times,
                                         devices::Coverage* coverage) {
  std::vector<devices::TestResult> results;
  if (all.program) results = st::run_tests(*all.program, times, coverage);
  if (all.configuration)
    for (auto& result :
         qmove::run_tests(*all.configuration, all.modules, devices::catalogue(), times, coverage))
      results.push_back(std::move(result));
  return results;
}

std::string told(const devices::TestFailure& failure) {
  return fmt::format("{}:{}: {}", failure.file, failure.line, to_string(failure));
}

constexpr auto* asserts_nothing = "it asserts nothing";

/// As a run has its checks: a suite a file.
std::vector<report::RunResult> as_runs(const std::vector<devices::TestResult>& results) {
  std::vector<report::RunResult> runs;
  for (const auto& result : results) {
    const auto same = [&](const report::RunResult& run) { return run.scenario == result.file; };
    auto run = std::find_if(runs.begin(), runs.end(), same);
    if (run == runs.end()) {
      runs.emplace_back();
      run = runs.end() - 1;
      run->scenario = result.file;
      run->name = run->scenario.stem().string();
    }
    record::CheckResult check;
    check.name =
        result.log.title.empty() ? result.name : fmt::format("{}: {}", result.name, result.log.title);
    check.passed = result.passed();
    if (check.passed && result.log.assertions == 0) check.doubt = asserts_nothing;
    for (const auto& failure : result.log.failures)
      check.detail = fmt::format("{}{}{}", check.detail, check.detail.empty() ? "" : "; ", told(failure));
    if (!check.passed) check.expectation = to_string(result.log.failures.front());
    const auto place =
        check.passed ? report::FilePlace{result.file, result.line}
                     : report::FilePlace{result.log.failures.front().file, result.log.failures.front().line};
    run->places.push_back(place);
    run->took.push_back(result.took_ns);
    run->outcome.checks.push_back(std::move(check));
    run->outcome.end += result.took_ns;
  }
  return runs;
}

/// What failed, and what could not fail.
std::vector<Annotation> annotations_of_tests(const std::vector<report::RunResult>& runs) {
  auto all = annotations_of(runs);
  for (const auto& run : runs)
    for (std::size_t i = 0; i < run.outcome.checks.size(); ++i) {
      const auto& check = run.outcome.checks[i];
      if (!check.judged_nothing()) continue;
      auto place = run.place_of(i);
      place.file = report::path_from_here(place.file);
      const auto title = printable(fmt::format("{}: {}", run.name, check.name));
      all.push_back({Annotation::Kind::warning, std::move(place), title, check.doubt, title});
    }
  return all;
}

void print_result(const devices::TestResult& result) {
  const bool passed = result.passed();
  fmt::print("{} {}{}{} ({} s{})\n", painted(passed ? "ok  " : "FAIL", passed ? Paint::good : Paint::bad),
             result.name, result.log.title.empty() ? "" : ": ", printable(result.log.title),
             record::seconds_text(result.took_ns), result.log.assertions == 0 ? ", asserts nothing" : "");
  for (const auto& failure : result.log.failures) fmt::print("  {}\n", printable(told(failure)));
  if (const auto more = result.log.failed - result.log.failures.size(); more > 0)
    fmt::print("  and {} more\n", more);
}

int test_files(const TestOptions& options) {
  Problems problems;
  const devices::TestTimes times{read_span_of(options.cycle, "--cycle", problems),
                                 read_span_of(options.timeout, "--timeout", problems)};
  check_annotate(options.annotate, problems);
  const auto check_file = [&](const char* option, const std::filesystem::path& file,
                              const Replacing& replacing) {
    if (file.empty()) return;
    for (const auto& input : options.files) {
      const auto before = problems.size();
      check_output(option, file.string(), {input, "program"}, replacing, problems);
      if (problems.size() != before) return;
    }
  };
  check_file("--junit", options.junit, {options.force || is_own_junit(options.junit)});
  check_file("--coverage", options.coverage, {options.force, devices::lcov_header});
  const auto programs = compile_all(options, problems);
  for (const auto& note : programs.notes()) fmt::print("note {}\n", to_string(note));
  devices::Coverage coverage;
  std::vector<devices::TestResult> results;
  if (problems.empty()) {
    results = run_all(programs, times, options.coverage.empty() ? nullptr : &coverage);
    if (results.empty())
      problems.push_back({"option.missing"_code, options.files.front().string(), 1, 1,
                          "there is no test in it",
                          "FUNCTION_BLOCK TEST_..., METHOD TEST_... or SUB TEST_... is one"});
  }
  if (!problems.empty()) {
    print_problems(problems);
    annotate(options.annotate, annotations_of(problems));
    return bad_input;
  }
  for (const auto& result : results) print_result(result);
  const auto failed =
      std::count_if(results.begin(), results.end(), [](const auto& result) { return !result.passed(); });
  fmt::print("{}, {} failed\n", counted(static_cast<std::int64_t>(results.size()), "test"), failed);
  const auto runs = as_runs(results);
  try {
    if (!options.junit.empty()) report::write_junit(runs, options.junit);
    if (!options.coverage.empty()) {
      write_file(options.coverage, devices::lcov_text(coverage));
      fmt::print("coverage: {}, {}\n", report::coverage_text(coverage), options.coverage.string());
    }
    annotate(options.annotate, annotations_of_tests(runs));
  } catch (const std::exception& error) {
    return print_failure(drycut::words_of(error));
  }
  return failed == 0 ? all_passed : check_failed;
}

void test_options(CLI::App& test, int& status) {
  const auto chosen = std::make_shared<TestOptions>();
  auto& options = *chosen;
  test.add_option(
          "files", options.files,
          "Structured Text (.st, or a folder of it), all of it one program; a configuration (.cnf) and "
          "its QCL modules (.mod)")
      ->required();
  test.add_option("--cycle", options.cycle, "A scan, or a round of tasks, begins so often")
      ->capture_default_str();
  test.add_option("--timeout", options.timeout, "A test that goes on longer has failed; simulated time")
      ->capture_default_str();
  test.add_option("--dialect", options.dialect,
                  "Of Structured Text, where IEC 61131-3 and CODESYS differ: 'drycut devices ST'")
      ->check(CLI::IsMember(std::vector<std::string>(st::dialect_names.begin(), st::dialect_names.end())));
  test.add_option("--junit", options.junit, "Write the results for CI, a suite a file, a case a test");
  test.add_option("--coverage", options.coverage,
                  "Write which lines and branches ran, for lcov and genhtml; the tests' own are left out");
  add_force(test, options.force);
  add_annotate(test, options.annotate);
  test.callback([chosen, &status] { status = test_files(*chosen); });
}

}  // namespace

Verb test_verb() {
  return {"test",
          "Run unit tests that programs have in their own language, without a machine",
          {"drycut test press.st press_test.st", "drycut test programs --junit out/tests.xml",
           "drycut test line.cnf press.mod --coverage coverage.info"},
          {"files", {FileKind::structured_text, FileKind::configuration, FileKind::module}},
          test_options};
}

}  // namespace drycut::sim::cli
