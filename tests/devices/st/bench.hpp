#pragma once
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/code.hpp"
#include "devices/plcopen/st/runtime.hpp"

namespace drycut::devices::plcopen::st {

/// A program behind a kernel with the axes Web (encoder) and Knife, 2 ms a scan.
class Bench {
 public:
  explicit Bench(const std::string& text, const CompileOptions& options = {}) {
    const Program program = compile(text, "test.st", problems, options);
    for (const auto& doubt : program.compiled().doubts)
      doubts.push_back(fmt::format("{}:{}: {}", doubt.line, doubt.column, doubt.text));
    for (const Problem& problem : problems) ADD_FAILURE() << to_string(problem);
    AxisParameters web;
    web.kind = AxisKind::encoder;
    kernel.add_axis("Web", web);
    kernel.add_axis("Knife", AxisParameters{});
    runtime = std::make_unique<Runtime>(program, kernel);
  }

  void scan(int times = 1) {
    for (int i = 0; i < times; ++i, time_ns += 2'000'000) {
      kernel.cycle();
      runtime->scan(time_ns);
    }
    if (const auto& fault = runtime->fault())
      FAIL() << fault->line << ":" << fault->column << ": " << fault->text;
  }
  [[nodiscard]] int find(const std::string& name) const {
    const auto symbols = runtime->symbols();
    for (std::size_t i = 0; i < symbols.size(); ++i)
      if (symbols[i].name == name) return static_cast<int>(i);
    return -1;
  }
  [[nodiscard]] double operator[](const std::string& name) const {
    const int symbol = find(name);
    if (symbol < 0) ADD_FAILURE() << "no symbol " << name;
    return symbol < 0 ? -1e99 : runtime->read(static_cast<std::size_t>(symbol));
  }
  void expect(const std::vector<std::pair<std::string, double>>& values) const {
    for (const auto& [name, value] : values) EXPECT_EQ((*this)[name], value) << name;
  }
  void set(const std::string& name, double value) {
    const int symbol = find(name);
    ASSERT_GE(symbol, 0) << "no symbol " << name;
    runtime->write(static_cast<std::size_t>(symbol), value);
  }

  Problems problems;
  std::vector<std::string> doubts;  ///< "line:column: text"
  MotionKernel kernel;
  std::unique_ptr<Runtime> runtime;
  std::int64_t time_ns = 0;
};

/// The problems of a text as "line:column: what; remedy".
inline std::vector<std::string> problems_of(const std::string& text, const CompileOptions& options = {}) {
  Problems problems;
  compile(text, "f", problems, options);
  std::vector<std::string> lines;
  for (const Problem& problem : problems) lines.push_back(to_string(problem).substr(2));
  return lines;
}

/// The problems of a text begin so, in this order, and there are no others; with a '$' behind it the whole
/// problem is told but for its code.
inline void expect_problems(const std::string& text, const std::vector<std::string>& beginnings) {
  std::vector<testing::Matcher<std::string>> matchers;
  matchers.reserve(beginnings.size());
  for (const std::string& told : beginnings)
    matchers.push_back(told.ends_with('$') ? testing::StartsWith(told.substr(0, told.size() - 1) + " [")
                                           : testing::StartsWith(told));
  EXPECT_THAT(problems_of(text), testing::ElementsAreArray(matchers)) << text;
}

/// Why a program stands after its first scan; a cold start leads out of it.
inline std::optional<RuntimeFault> fault_in_first_scan(const std::string& text) {
  Problems problems;
  MotionKernel kernel;
  Runtime runtime(compile(text, "f", problems), kernel);
  for (const Problem& problem : problems) ADD_FAILURE() << to_string(problem);
  runtime.scan(0);
  auto fault = runtime.fault();
  runtime.scan(1);
  runtime.cold_start();
  EXPECT_FALSE(runtime.fault());
  return fault;
}

/// The value of an expression in a variable of type `type`; `vars` are further declarations.
inline double value_of(const std::string& type, const std::string& expression, const std::string& vars = "") {
  Bench bench("PROGRAM main VAR x : " + type + "; " + vars + " END_VAR x := " + expression + "; END_PROGRAM");
  bench.scan();
  return bench["x"];
}

/// The values of expressions.
inline void expect_values(const std::string& type,
                          const std::vector<std::pair<std::string, double>>& expressions,
                          const std::string& vars = "") {
  for (const auto& [expression, value] : expressions)
    EXPECT_EQ(value_of(type, expression, vars), value) << expression;
}

/// Statements after declarations, run once; the value of `x`.
inline double run(const std::string& vars, const std::string& statements, const std::string& units = "") {
  Bench bench(units + " PROGRAM main VAR " + vars + " END_VAR " + statements + " END_PROGRAM");
  bench.scan();
  return bench["x"];
}

}  // namespace drycut::devices::plcopen::st
