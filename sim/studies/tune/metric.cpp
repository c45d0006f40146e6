#include "sim/studies/tune/metric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "sim/loop/statistics.hpp"
#include "sim/scenario/expression_tree.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

struct FigureName {
  std::string_view name;
  double LoopFigures::*figure;
  const char* unit;
};
constexpr FigureName figure_names[] = {{"phase_margin", &LoopFigures::phase_margin, "deg"},
                                       {"gain_margin", &LoopFigures::gain_margin, "dB"},
                                       {"max_sensitivity", &LoopFigures::max_sensitivity, ""}};

std::string list_of_values(const loop::KnownEvent& event) {
  std::string list;
  for (const auto& [name, unit] : event.values) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

class Metric::Compiler {
 public:
  Compiler(std::string_view text, Kind kind, const std::vector<loop::KnownEvent>& events,
           std::vector<scenario::ExpressionFault>& faults, const UnitOf& unit_of)
      : text_(text), kind_(kind), events_(events), faults_(faults), unit_of_(unit_of) {}

  std::optional<Metric> run() {
    const auto before = faults_.size();
    metric_.kind_ = kind_;
    metric_.text_ = text_;
    metric_.formula_ = scenario::Expression::compile(
        text_, [this](const std::string& name) { return outside(name); }, {}, faults_,
        kind_ == Kind::number ? scenario::Expression::Kind::number : scenario::Expression::Kind::limit,
        [this](const std::string& name) { return inside(name); });
    if (!metric_.formula_) return {};
    for (const auto& statistic : metric_.formula_->statistics()) add_term(statistic);
    if (metric_.terms_.empty() && metric_.figures_.empty())
      fault("expression.kind"_code, 0, "nothing recorded is in it",
            "for example rms(AxisX.follerr), sd(cut.length)");
    if (kind_ == Kind::number && faults_.size() == before) refuse_comparison();
    if (faults_.size() != before) return {};
    return std::move(metric_);
  }

 private:
  void fault(Code code, std::size_t offset, std::string what, std::string remedy) {
    faults_.push_back({code, offset, std::move(what), std::move(remedy)});
  }

  scenario::Expression::Operand outside(const std::string& name) {
    for (const auto& [figure, member, unit] : figure_names) {
      if (figure != name) continue;
      if (kind_ == Kind::number)
        return scenario::Expression::Operand::refused(
            "expression.not-here"_code, fmt::format("{} is measured for constraints only", name),
            "put a limit into --constraint");
      return {&metric_.figures_.emplace_back(Figure{member, 0}).number, unit};
    }
    return scenario::Expression::Operand::refused(
        "expression.not-here"_code, fmt::format("'{}' stands outside a term", name),
        fmt::format("write max({0}), min({0}), mean({0}), rms({0}), sd({0}) or settling({0}, band)", name));
  }

  scenario::Expression::Operand inside(const std::string& text) {
    const auto [name, unit, fault] = named(text);
    if (fault) return scenario::Expression::Operand::refused(fault->code, fault->what, fault->remedy);
    const auto slot = std::find_if(metric_.slots_.begin(), metric_.slots_.end(),
                                   [&](const Slot& known) { return known.name.text == text; });
    auto& of_name = slot == metric_.slots_.end() ? metric_.slots_.emplace_back(Slot{name, 0}) : *slot;
    return {&of_name.number, unit};
  }

  struct Named {
    MetricName name;
    std::optional<std::string> unit;
    std::optional<scenario::ExpressionFault> fault = {};
  };
  [[nodiscard]] Named named(const std::string& text) const {
    for (const auto& event : events_) {
      for (const auto& [value, unit] : event.values) {
        if (text == event.name + "." + value) return {{text, 0, event.name, value}, unit};
        const auto full = fmt::format("{}.{}", event.source, event.name);
        if (text == full + "." + value) return {{text, 0, full, value}, unit};
      }
    }
    for (const auto& event : events_) {
      const bool a_plant = std::any_of(events_.begin(), events_.end(), [&](const loop::KnownEvent& other) {
        return other.source == event.name;
      });
      if (a_plant || !text.starts_with(event.name + ".")) continue;
      return {{},
              {},
              scenario::ExpressionFault{"scenario.unknown-event"_code, 0,
                                        fmt::format("the event {} has no value '{}'", event.name,
                                                    text.substr(event.name.size() + 1)),
                                        "its values: " + list_of_values(event)}};
    }
    return {{text, 0, "", ""}, unit_of_ ? unit_of_(text) : std::nullopt};
  }

  void add_term(const scenario::ExpressionStatistic& statistic) {
    auto& term = metric_.terms_.emplace_back();
    for (const auto& [text, offset] : statistic.names) {
      for (auto& slot : metric_.slots_) {
        if (slot.name.text != text) continue;
        if (slot.name.offset == 0) slot.name.offset = offset;
        term.push_back(&slot);
      }
      if (term.back()->name.event != term.front()->name.event)
        fault("expression.kind"_code, offset,
              fmt::format("{} and {} do not happen together", term.front()->name.text, text),
              "a term looks at channels, or at the values of one event");
    }
  }

  void refuse_comparison() {
    for (const auto& token : scenario::scan_expression(text_, faults_)) {
      if (!scenario::is_relation(token.text) && token.text != "==" && token.text != "&&" &&
          token.text != "||")
        continue;
      return fault("expression.kind"_code, token.offset, "a metric is a number, not a comparison",
                   "put limits into --constraint");
    }
  }

  std::string_view text_;
  Kind kind_;
  const std::vector<loop::KnownEvent>& events_;
  std::vector<scenario::ExpressionFault>& faults_;
  const UnitOf& unit_of_;
  Metric metric_;
};

std::optional<Metric> Metric::compile(std::string_view text, Kind kind,
                                      const std::vector<loop::KnownEvent>& events,
                                      std::vector<scenario::ExpressionFault>& faults, const UnitOf& unit_of) {
  return Compiler(text, kind, events, faults, unit_of).run();
}

std::vector<MetricName> Metric::names() const {
  std::vector<MetricName> all;
  all.reserve(slots_.size());
  for (const auto& slot : slots_) all.push_back(slot.name);
  return all;
}

void Metric::take(std::size_t term, const record::Recording& recording, Time from) {
  const auto& slots = terms_[term];
  if (!slots[0]->name.event.empty()) {
    std::vector<loop::EventNumbers> values;
    values.reserve(slots.size());
    for (const auto* slot : slots)
      values.push_back(
          loop::event_numbers(recording.events(), slot->name.event, slot->name.value, seconds(from)));
    const auto rows = std::ranges::min(values, {}, [](const auto& v) { return v.times.size(); }).times.size();
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < values.size(); ++i) slots[i]->number = values[i].numbers[row];
      formula_->take(term, values.back().times[row]);
    }
    return;
  }
  std::vector<const record::Series<double>*> columns;
  columns.reserve(slots.size());
  for (const auto* slot : slots) {
    const auto* column = recording.column(slot->name.text);
    if (column == nullptr) return;
    columns.push_back(&column->values);
  }
  for (std::size_t row = 0; row < recording.times().size(); ++row) {
    if (recording.times()[row] < from) continue;
    for (std::size_t i = 0; i < columns.size(); ++i) slots[i]->number = (*columns[i])[row];
    formula_->take(term, seconds(recording.times()[row]));
  }
}

bool Metric::follow(loop::Watch& watch, Time from) {
  from_ = from;
  bool any = false;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    if (!terms_[i][0]->name.event.empty()) continue;
    for (auto* slot : terms_[i]) slot->followed = watch.slot(slot->name.text);
    formula_->start(i, seconds(from));
    any = true;
  }
  return any;
}

void Metric::take(Time now) {
  if (now < from_) return;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    if (!follows(i)) continue;
    for (auto* slot : terms_[i]) slot->number = *slot->followed;
    formula_->take(i, seconds(now));
  }
}

std::string Metric::unit() const {
  auto head = trimmed(text_);
  if (head.starts_with('-')) head = trimmed(head.substr(1));
  const auto is_all = [&](std::string_view term) {
    if (!head.starts_with(term)) return false;
    const auto rest = trimmed(head.substr(term.size()));
    return rest.empty() || ((rest[0] == '<' || rest[0] == '>') && rest.find("&&") == std::string_view::npos);
  };
  for (const auto& statistic : formula_->statistics())
    if (is_all(statistic.text)) return statistic.unit;
  for (const auto& figure : figure_names)
    if (is_all(figure.name)) return figure.unit;
  return "";
}

bool Metric::needs_loop() const { return !figures_.empty(); }

double Metric::value(const record::Recording& recording, Time from, const LoopFigures& loop) {
  for (auto& figure : figures_) {
    figure.number = loop.*figure.figure;
    if (std::isnan(figure.number)) return nothing;
  }
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    if (follows(i)) continue;
    formula_->start(i, seconds(from));
    take(i, recording, from);
  }
  formula_->finish();
  for (const auto& statistic : formula_->statistics())
    if (std::isnan(statistic.value)) return nothing;
  return kind_ == Kind::number ? formula_->value() : formula_->evaluate().margin.value_or(nothing);
}

MetricSteps::MetricSteps(loop::Simulation& simulation, const std::vector<Metric*>& metrics, Time from)
    : watch_(simulation.names()) {
  for (auto* metric : metrics)
    if (metric->follow(watch_, from)) metrics_.push_back(metric);
  if (!metrics_.empty()) simulation.tell_steps(*this);
}

void MetricSteps::stepped(Time now) {
  watch_.update();
  for (auto* metric : metrics_) metric->take(now);
}

}  // namespace drycut::sim::studies
