#include "sim/studies/half_step.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "sim/scenario/format.hpp"

namespace drycut::sim::studies {

namespace {

std::string number(double value, const std::string& unit) {
  return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
}

std::string cell(const record::CheckResult& check) {
  return fmt::format("{}{}", check.passed ? "PASS" : "FAIL",
                     check.margin ? " " + number(*check.margin, check.unit) : "");
}

}  // namespace

std::optional<scenario::Override> halved_step(const scenario::Scenario& scenario, Problems& problems) {
  const auto& scene = scenario.scene;
  if (scene.step % 2 == 0) return scenario::Override{"scene.step", scenario::format_time(scene.step / 2)};
  problems.push_back(scenario::problem_at(
      "scenario.time-grid"_code, scenario, scene.step_place,
      fmt::format("--verify-step: half of scene.step {} is no whole number of nanoseconds",
                  scenario::format_time(scene.step)),
      "choose an even number of nanoseconds"));
  return {};
}

record::HalfStep run_half_step(scenario::Scenario scenario, const std::function<void(Time)>& progress) {
  scenario.pictures = {};
  scenario.record.channels.clear();
  Problems problems;
  loop::Simulation simulation(scenario, problems);
  if (!problems.empty()) throw std::runtime_error("at half the step: " + to_string(problems.front()));
  simulation.keep_nothing();
  auto outcome = simulation.run(progress);
  return {scenario.scene.step, std::move(outcome.failure), std::move(outcome.checks)};
}

std::optional<double> moved(const record::CheckResult& check, const record::CheckResult& at_half) {
  if (!check.margin || !at_half.margin) return {};
  return *at_half.margin - *check.margin;
}

renders::ReportTable margin_table(const record::Outcome& outcome, Time step) {
  const auto& half = outcome.half_step.value();
  renders::ReportTable table{"Margins at half the step",
                             {"check", "margin at " + scenario::format_time(step),
                              "margin at " + scenario::format_time(half.step), "moved by"},
                             {},
                             false,
                             true};
  for (std::size_t i = 0; i < outcome.checks.size() && i < half.checks.size(); ++i) {
    const auto& check = outcome.checks[i];
    const auto& other = half.checks[i];
    const auto by = moved(check, other);
    table.rows.push_back(
        {{check.name, cell(check), cell(other),
          fmt::format("{}{}", by ? number(*by, check.unit) : "",
                      check.passed == other.passed ? "" : " : the verdict depends on the step")}});
  }
  if (!half.failure.empty()) table.rows.push_back({{"the simulation", "PASS", "FAIL", half.failure}});
  return table;
}

}  // namespace drycut::sim::studies
