#include "sim/studies/compare/scene_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "sim/scenario/archive.hpp"
#include "sim/studies/tune/metric.hpp"

namespace drycut::sim::studies {

namespace {

using Names = std::vector<std::pair<std::string, std::string>>;

const std::string* unit_of(const Names& channels, const std::string& name) {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const auto& channel) { return channel.first == name; });
  return found == channels.end() ? nullptr : &found->second;
}

std::vector<std::string> names_only(const Names& channels) {
  std::vector<std::string> names;
  for (const auto& [name, unit] : channels) names.push_back(name);
  return names;
}

void tell(const ComparisonScene& scene, const scenario::Text& text,
          const std::vector<scenario::ExpressionFault>& faults, const std::string& prefix,
          Problems& problems) {
  for (const auto& fault : faults) {
    auto problem = scene.problem(fault.code, text.at(fault.offset), prefix + fault.what, fault.remedy);
    if (std::ranges::find(problems, problem) == problems.end()) problems.push_back(std::move(problem));
  }
}

std::string not_recorded(const ComparisonScene::Member& member) {
  return fmt::format("record it in {}, or give {} a channel of that name", member.scenario.text,
                     member.name.text);
}

/// A formula over channels: its number at one instant.
class Formula {
 public:
  Formula(const std::string& text, const Names& channels, std::vector<scenario::ExpressionFault>& faults) {
    const auto resolve = [&](const std::string& name) -> scenario::Expression::Operand {
      const auto* unit = unit_of(channels, name);
      if (unit == nullptr) return nullptr;
      slots_.push_back({name, 0});
      return {&slots_.back().number, *unit};
    };
    expression_ = scenario::Expression::compile(text, resolve, names_only(channels), faults,
                                                scenario::Expression::Kind::number);
  }

  void over(const record::Recording& recording, record::Series<double>& numbers) {
    std::vector<const record::Recording::Column*> columns;
    columns.reserve(slots_.size());
    for (const auto& slot : slots_) columns.push_back(recording.column(slot.name));
    for (std::size_t row = 0; row < recording.times().size(); ++row) {
      for (std::size_t i = 0; i < slots_.size(); ++i) slots_[i].number = columns[i]->values[row];
      numbers.push_back(expression_->value());
    }
  }

 private:
  struct Slot {
    std::string name;
    double number = 0;
  };
  std::deque<Slot> slots_;
  std::optional<scenario::Expression> expression_;
};

/// What a member records, and what the scene makes of it.
Names channels_of(const ComparisonScene::Member& member, const MemberNames& names) {
  auto channels = names.channels;
  for (const auto& channel : member.channels) channels.emplace_back(channel.name.text, channel.unit);
  return channels;
}

void check_channels(const ComparisonScene& scene, const ComparisonScene::Member& member,
                    const MemberNames& names, Problems& problems) {
  for (const auto& channel : member.channels) {
    if (unit_of(names.channels, channel.name.text) != nullptr) {
      problems.push_back(
          scene.problem("scenario.twice"_code, channel.name.place,
                        fmt::format("{} records a channel {} already", member.name.text, channel.name.text),
                        "give it another name"));
    }
    if (channel.of.text.empty()) continue;
    std::vector<scenario::ExpressionFault> faults;
    const Formula formula(channel.of.text, names.channels, faults);
    tell(scene, channel.of, faults, member.name.text + ": ", problems);
  }
}

std::optional<Metric> compile_figure(const ComparisonScene::FigureRequest& figure, const Names& channels,
                                     const MemberNames& names,
                                     std::vector<scenario::ExpressionFault>& faults) {
  return Metric::compile(figure.of.text, Metric::Kind::number, names.events, faults,
                         [&](const std::string& name) -> std::optional<std::string> {
                           const auto* unit = unit_of(channels, name);
                           if (unit == nullptr) return {};
                           return *unit;
                         });
}

void check_figures(const ComparisonScene& scene, const ComparisonScene::Member& member,
                   const MemberNames& names, Problems& problems) {
  const auto channels = channels_of(member, names);
  for (const auto& figure : scene.figures) {
    if (figure.of.text.empty()) continue;
    std::vector<scenario::ExpressionFault> faults;
    const auto metric = compile_figure(figure, channels, names, faults);
    tell(scene, figure.of, faults, "", problems);
    if (!metric) continue;
    for (const auto& name : metric->names()) {
      if (!name.event.empty() || unit_of(channels, name.text) != nullptr) continue;
      problems.push_back(scene.problem("compare.unknown-name"_code, figure.of.at(name.offset),
                                       fmt::format("{} does not record {}", member.name.text, name.text),
                                       not_recorded(member)));
    }
  }
}

bool has_value(const MemberNames& names, const std::string& event, const std::string& value) {
  return std::any_of(names.events.begin(), names.events.end(), [&](const loop::KnownEvent& known) {
    return loop::names_event(event, known.source, known.name) &&
           (value.empty() || unit_of(known.values, value) != nullptr);
  });
}

void check_panel(const ComparisonScene& scene, const ComparisonScene::Member& member,
                 const MemberNames& names, const scenario::PlotRequest::Panel& panel, Problems& problems) {
  const auto channels = channels_of(member, names);
  for (const auto* list : {&panel.channels, &panel.lanes}) {
    for (const auto& name : *list) {
      if (unit_of(channels, name.text) != nullptr) continue;
      problems.push_back(scene.problem("compare.unknown-name"_code, name.place,
                                       fmt::format("{} does not record {}", member.name.text, name.text),
                                       not_recorded(member)));
    }
  }
  for (const auto& value : panel.values) {
    if (has_value(names, panel.event.text, value.text)) continue;
    problems.push_back(scene.problem(
        "compare.unknown-name"_code, value.place,
        fmt::format("{} has no event {} with a value {}", member.name.text, panel.event.text, value.text),
        "drycut plants lists the events of a plant"));
  }
}

void check_plots(const ComparisonScene& scene, const ComparisonScene::Member& member,
                 const MemberNames& names, Problems& problems) {
  for (const auto& request : scene.plots) {
    for (const auto& panel : request.plot.panels) check_panel(scene, member, names, panel, problems);
    if (request.around && !has_value(names, request.around->event.text, ""))
      problems.push_back(
          scene.problem("compare.unknown-name"_code, request.around->event.place,
                        fmt::format("{} has no event {}", member.name.text, request.around->event.text),
                        "drycut plants lists the events of a plant"));
  }
}

// ---- checks over figures ----

/// Every number that a check can name: RUN.figure and RUN.passed.
struct CheckOperand {
  std::string name;
  std::string unit;
  double number = 0;
};
std::deque<CheckOperand> operands_of(const ComparisonScene& scene) {
  std::deque<CheckOperand> operands;
  for (const auto& member : scene.members) {
    operands.push_back({member.name.text + ".passed", "", 0});
    for (const auto& figure : scene.figures)
      operands.push_back({member.name.text + "." + figure.name.text, figure.unit, 0});
  }
  return operands;
}

std::optional<scenario::Expression> compile_check(const ComparisonScene::Check& check,
                                                  const std::deque<CheckOperand>& operands,
                                                  std::vector<const CheckOperand*>& used,
                                                  std::vector<scenario::ExpressionFault>& faults) {
  std::vector<std::string> known;
  for (const auto& operand : operands) known.push_back(operand.name);
  const auto resolve = [&](const std::string& name) -> scenario::Expression::Operand {
    for (const auto& operand : operands) {
      if (operand.name != name) continue;
      if (std::find(used.begin(), used.end(), &operand) == used.end()) used.push_back(&operand);
      return {&operand.number, operand.unit};
    }
    return nullptr;
  };
  return scenario::Expression::compile(check.expect.text, resolve, known, faults);
}

std::string operand_text(const CheckOperand& operand) {
  if (std::isnan(operand.number)) return fmt::format("{} has no value in the time looked at", operand.name);
  return fmt::format("{}={:.6g}{}{}", operand.name, record::without_noise(operand.number),
                     operand.unit.empty() ? "" : " ", operand.unit);
}

record::CheckResult result_of(const ComparisonScene::Check& check, const std::deque<CheckOperand>& operands) {
  std::vector<const CheckOperand*> used;
  std::vector<scenario::ExpressionFault> faults;
  const auto expression = compile_check(check, operands, used, faults);
  const auto evaluation = expression ? expression->evaluate() : scenario::Evaluation{};
  record::CheckResult result{
      check.name.text, check.expect.text, evaluation.holds, evaluation.margin, "", {}, ""};
  for (const auto* operand : used) {
    result.detail += (result.detail.empty() ? "" : "; ") + operand_text(*operand);
    const bool mixed = operand != used.front() && operand->unit != result.unit;
    result.unit = mixed ? "" : operand->unit;
    if (mixed) break;
  }
  return result;
}

// ---- runs ----

/// The run with the channels that the scene makes of what it recorded.
void add_channels(const ComparisonScene::Member& member, const MemberNames& names, ComparedRun& run) {
  for (const auto& channel : member.channels) {
    std::vector<scenario::ExpressionFault> faults;
    Formula formula(channel.of.text, names.channels, faults);
    formula.over(run.recording, run.recording.add(channel.name.text, channel.unit).values);
  }
}

double number_of(const ComparisonScene::FigureRequest& figure, const ComparisonScene& scene,
                 const Names& channels, const MemberNames& names, const ComparedRun& run) {
  std::vector<scenario::ExpressionFault> faults;
  auto metric = compile_figure(figure, channels, names, faults);
  return metric ? metric->value(run.recording, scene.from.value_or(0))
                : std::numeric_limits<double>::quiet_NaN();
}

std::string verdict_of(const Comparison& comparison, const std::vector<record::CheckResult>& checks) {
  const auto runs = std::count_if(comparison.runs.begin(), comparison.runs.end(),
                                  [](const ComparedRun& run) { return !run.outcome.passed(); });
  const auto failed = std::count_if(checks.begin(), checks.end(),
                                    [](const record::CheckResult& check) { return !check.passed; });
  const auto of_runs = runs == 0 ? std::string("every run passed")
                                 : fmt::format("{} of {} runs failed", runs, comparison.runs.size());
  if (checks.empty()) return of_runs;
  return fmt::format("{}, {}", of_runs,
                     failed == 0
                         ? "and so did the comparison's own checks"
                         : fmt::format("{} of the comparison's own {} checks failed", failed, checks.size()));
}

}  // namespace

MemberNames names_of(const loop::Simulation& simulation) {
  MemberNames names;
  for (const auto& column : simulation.recording().columns())
    names.channels.emplace_back(column.name, column.unit);
  names.events = simulation.known_events();
  return names;
}

void check_comparison(const ComparisonScene& scene, const std::vector<MemberNames>& names,
                      Problems& problems) {
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    check_channels(scene, scene.members[i], names[i], problems);
    check_figures(scene, scene.members[i], names[i], problems);
    check_plots(scene, scene.members[i], names[i], problems);
  }
  const auto operands = operands_of(scene);
  for (const auto& check : scene.checks) {
    if (check.expect.text.empty()) continue;
    std::vector<const CheckOperand*> used;
    std::vector<scenario::ExpressionFault> faults;
    compile_check(check, operands, used, faults);
    tell(scene, check.expect, faults, "", problems);
  }
}

ComparedScene compare_members(const ComparisonScene& scene, const std::vector<MemberNames>& names,
                              std::vector<ComparedRun> runs) {
  for (std::size_t i = 0; i < runs.size(); ++i) add_channels(scene.members[i], names[i], runs[i]);
  ComparedScene result;
  std::optional<double> from;
  if (scene.from) from = seconds(*scene.from);
  result.comparison = compare(std::move(runs), from);
  auto& page = result.page;
  page.title = scene.title.empty() ? scene.file.stem().string() : scene.title;
  page.source = scene.file.filename().string();
  page.scenarios = {scene.file.generic_string()};
  page.overlays = scene.plots;
  auto operands = operands_of(scene);
  for (const auto& figure : scene.figures) page.figures.push_back({figure.title, figure.unit, {}});
  auto operand = operands.begin();
  for (std::size_t i = 0; i < scene.members.size(); ++i) {
    const auto& run = result.comparison.runs[i];
    const auto channels = channels_of(scene.members[i], names[i]);
    (operand++)->number = run.outcome.passed() ? 1 : 0;
    for (std::size_t k = 0; k < scene.figures.size(); ++k) {
      const double number = number_of(scene.figures[k], scene, channels, names[i], run);
      page.figures[k].numbers.push_back(number);
      (operand++)->number = number;
    }
  }
  for (const auto& check : scene.checks) page.checks.push_back(result_of(check, operands));
  const auto& ran = result.comparison.runs;
  page.passed =
      std::all_of(page.checks.begin(), page.checks.end(), [](const auto& check) { return check.passed; }) &&
      std::all_of(ran.begin(), ran.end(), [](const auto& run) { return run.outcome.passed(); });
  page.verdict = verdict_of(result.comparison, page.checks);
  return result;
}

}  // namespace drycut::sim::studies
