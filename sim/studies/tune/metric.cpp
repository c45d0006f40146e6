#include "sim/studies/tune/metric.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "base/problem.hpp"
#include "sim/report/statistics.hpp"
#include "sim/scenario/expression_scan.hpp"

namespace drycut::sim::studies {

namespace {

using Token = scenario::ExpressionToken::Kind;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The value of an expression that was compiled as "(text) >= 0".
double number_of(const scenario::Expression& expression) {
  const auto margin = expression.evaluate().margin;
  return margin ? *margin : nothing;
}

/// The figure of the loop called `name`; nullptr if there is none.
double LoopFigures::*figure_of(std::string_view name) {
  if (name == "phase_margin") return &LoopFigures::phase_margin;
  if (name == "gain_margin") return &LoopFigures::gain_margin;
  if (name == "max_sensitivity") return &LoopFigures::max_sensitivity;
  return nullptr;
}

std::string list_of_values(const loop::KnownEvent& event) {
  std::string list;
  for (const auto& [name, unit] : event.values) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace

// Takes the aggregate terms out of a formula. Every term leaves a name of the same width behind, so that
// faults keep their place.
class Metric::Compiler {
 public:
  Compiler(std::string_view text, const std::vector<loop::KnownEvent>& events,
           std::vector<scenario::ExpressionFault>& faults)
      : text_(text), formula_(text), events_(events), faults_(faults) {}

  std::optional<Metric> run(Metric::Kind kind) {
    const auto before = faults_.size();
    tokens_ = scenario::scan_expression(text_, faults_);
    if (faults_.size() != before) return {};
    Metric metric;
    bool figures = false;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (tokens_[i].kind == Token::function && is_aggregate(i)) {
        take(i, metric);
        i = tokens_[i + 1].partner;
      } else if (tokens_[i].kind == Token::name && figure_of(tokens_[i].text) != nullptr) {
        figures = true;
        if (kind == Metric::Kind::number)
          fault(tokens_[i].offset, fmt::format("{} is measured for constraints only", tokens_[i].text),
                "put a limit into --constraint");
      } else if (tokens_[i].kind == Token::name && tokens_[i].text != "_pi" && tokens_[i].text != "_e") {
        fault(tokens_[i].offset, fmt::format("'{}' stands outside a term", tokens_[i].text),
              fmt::format("write max({0}), min({0}), mean({0}), rms({0}), sd({0}) or settling({0}, band)",
                          tokens_[i].text));
      }
    }
    if (faults_.size() == before && metric.terms_.empty() && !figures)
      fault(0, "nothing recorded is in it", "for example rms(AxisX.follerr), sd(cut.length)");
    if (faults_.size() != before) return {};
    metric.formula_ = outer(metric, kind);
    if (faults_.size() != before) return {};
    return metric;
  }

 private:
  void fault(std::size_t offset, std::string what, std::string remedy) {
    faults_.push_back({offset, std::move(what), std::move(remedy)});
  }

  static const std::map<std::string, Function>& functions() {
    static const std::map<std::string, Function> all = {
        {"max", Function::max},          {"min", Function::min}, {"mean", Function::mean},
        {"rms", Function::rms},          {"sd", Function::sd},   {"count", Function::count},
        {"settling", Function::settling}};
    return all;
  }

  // Commas between the arguments of the call whose function is token `i`.
  [[nodiscard]] std::vector<std::size_t> commas(std::size_t i) const {
    std::vector<std::size_t> found;
    for (std::size_t k = i + 2; k < tokens_[i + 1].partner; ++k) {
      if (tokens_[k].kind == Token::open) k = tokens_[k].partner;
      if (tokens_[k].text == ",") found.push_back(k);
    }
    return found;
  }

  [[nodiscard]] bool is_aggregate(std::size_t i) const {
    const auto known = functions().find(tokens_[i].text);
    if (known == functions().end()) return false;
    const bool plain = known->second == Function::max || known->second == Function::min;
    return !plain || commas(i).empty();
  }

  void take(std::size_t i, Metric& metric) {
    const auto close = tokens_[i + 1].partner;
    auto& term = metric.terms_.emplace_back();
    term.function = functions().at(tokens_[i].text);
    for (std::size_t k = i + 2; k < close; ++k)
      if (tokens_[k].kind == Token::function && is_aggregate(k))
        return fault(tokens_[k].offset, fmt::format("{} inside {}", tokens_[k].text, tokens_[i].text),
                     "a term looks at channels or event values");
    const auto separators = commas(i);
    const std::size_t wanted = term.function == Function::settling ? 1 : 0;
    if (separators.size() != wanted)
      return fault(
          tokens_[i].offset, fmt::format("{} has {} arguments", tokens_[i].text, separators.size() + 1),
          wanted == 1 ? "write settling(AxisX.follerr, 10): the expression and its band" : "it takes one");
    const auto begin = tokens_[i + 1].offset + 1;
    const auto end = separators.empty() ? tokens_[close].offset : tokens_[separators[0]].offset;
    compile_inside(term, begin, end);
    if (wanted == 1) read_band(term, end + 1, tokens_[close].offset);
    const auto start = tokens_[i].offset;
    auto name = fmt::format("t{}", metric.terms_.size());
    name.resize(tokens_[close].end - start, ' ');
    formula_.replace(start, name.size(), name);
  }

  void compile_inside(Term& term, std::size_t begin, std::size_t end) {
    const auto wrapped = fmt::format("({}) >= 0", text_.substr(begin, end - begin));
    const auto resolve = [&](const std::string& text) -> const double* {
      for (auto& slot : term.slots)
        if (slot.name.text == text) return &slot.number;
      term.slots.push_back({named(text), 0});
      return &term.slots.back().number;
    };
    std::vector<scenario::ExpressionFault> own;
    term.expression = scenario::Expression::compile(wrapped, resolve, {}, own);
    for (auto& found : own) {
      found.offset += begin;
      found.offset -= std::min<std::size_t>(found.offset, 1);
      faults_.push_back(std::move(found));
    }
    if (own.empty() && term.slots.empty())
      return fault(begin, "no channel and no event value is in it", "for example rms(AxisX.follerr)");
    place_names(term, begin, end);
    for (const auto& slot : term.slots)
      if (slot.name.event != term.slots[0].name.event)
        return fault(slot.name.offset,
                     fmt::format("{} and {} do not happen together", term.slots[0].name.text, slot.name.text),
                     "a term looks at channels, or at the values of one event");
  }

  void place_names(Term& term, std::size_t begin, std::size_t end) const {
    for (auto& slot : term.slots)
      for (const auto& token : tokens_)
        if (token.offset >= begin && token.offset < end && token.kind == Token::name &&
            token.text == slot.name.text) {
          slot.name.offset = token.offset;
          break;
        }
  }

  MetricName named(const std::string& text) {
    for (const auto& event : events_) {
      for (const auto& [value, unit] : event.values) {
        if (text == event.name + "." + value) return {text, 0, event.name, value};
        const auto full = event.source + "." + event.name;
        if (text == full + "." + value) return {text, 0, full, value};
      }
    }
    for (const auto& event : events_) {
      const bool a_plant = std::any_of(events_.begin(), events_.end(), [&](const loop::KnownEvent& other) {
        return other.source == event.name;
      });
      if (a_plant || !text.starts_with(event.name + ".")) continue;
      fault(text_.find(text),
            fmt::format("the event {} has no value '{}'", event.name, text.substr(event.name.size() + 1)),
            "its values: " + list_of_values(event));
      break;
    }
    return {text, 0, "", ""};
  }

  void read_band(Term& term, std::size_t begin, std::size_t end) {
    std::vector<scenario::ExpressionFault> own;
    const auto band = scenario::Expression::compile(
        fmt::format("({}) >= 0", text_.substr(begin, end - begin)),
        [](const std::string&) -> const double* { return nullptr; }, {}, own);
    if (band) term.band = number_of(*band);
    if (!band || !(term.band >= 0))
      fault(begin, "the band of settling is no number from 0 on", "for example settling(AxisX.follerr, 10)");
  }

  std::optional<scenario::Expression> outer(Metric& metric, Metric::Kind kind) {
    const bool number = kind == Metric::Kind::number;
    const auto resolve = [&](const std::string& name) -> const double* {
      for (std::size_t i = 0; i < metric.terms_.size(); ++i)
        if (name == fmt::format("t{}", i + 1)) return &metric.terms_[i].result;
      const auto figure = figure_of(name);
      return figure == nullptr ? nullptr : &metric.figures_.emplace_back(Figure{figure, 0}).number;
    };
    if (number) {
      for (const auto& token : tokens_)
        if (scenario::is_relation(token) || token.text == "==" || token.text == "&&" || token.text == "||") {
          fault(token.offset, "a metric is a number, not a comparison", "put limits into --constraint");
          return {};
        }
    }
    std::vector<scenario::ExpressionFault> own;
    auto made =
        scenario::Expression::compile(number ? "(" + formula_ + ") >= 0" : formula_, resolve, {}, own);
    for (auto& found : own) {
      if (number) found.offset -= std::min<std::size_t>(found.offset, 1);
      faults_.push_back(std::move(found));
    }
    if (made && !made->has_margin()) {
      fault(0, "a constraint compares by < <= > >=", "for example max(abs(knife.motor.torque)) <= 20");
      return {};
    }
    return made;
  }

  std::string_view text_;
  std::string formula_;
  const std::vector<loop::KnownEvent>& events_;
  std::vector<scenario::ExpressionFault>& faults_;
  scenario::ExpressionTokens tokens_;
};

std::optional<Metric> Metric::compile(std::string_view text, Kind kind,
                                      const std::vector<loop::KnownEvent>& events,
                                      std::vector<scenario::ExpressionFault>& faults) {
  return Compiler(text, events, faults).run(kind);
}

std::vector<MetricName> Metric::names() const {
  std::vector<MetricName> all;
  for (const auto& term : terms_)
    for (const auto& slot : term.slots)
      if (std::none_of(all.begin(), all.end(), [&](const MetricName& n) { return n.text == slot.name.text; }))
        all.push_back(slot.name);
  return all;
}

Metric::Numbers Metric::series_of(Term& term, const loop::Recording& recording, Time from) {
  Numbers series;
  const auto add = [&](double time) {
    series.times.push_back(time);
    series.numbers.push_back(number_of(*term.expression));
  };
  if (!term.slots[0].name.event.empty()) {
    std::vector<report::EventNumbers> values;
    for (const auto& [name, number] : term.slots)
      values.push_back(report::event_numbers(recording.events(), name.event, name.value, seconds(from)));
    const auto rows = std::ranges::min(values, {}, [](const auto& v) { return v.times.size(); }).times.size();
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t i = 0; i < values.size(); ++i) term.slots[i].number = values[i].numbers[row];
      add(values.back().times[row]);
    }
    return series;
  }
  std::vector<const loop::Series<double>*> columns;
  for (const auto& slot : term.slots) {
    const auto* column = recording.column(slot.name.text);
    if (column == nullptr) return {};
    columns.push_back(&column->values);
  }
  for (std::size_t row = 0; row < recording.times().size(); ++row) {
    if (recording.times()[row] < from) continue;
    for (std::size_t i = 0; i < columns.size(); ++i) term.slots[i].number = (*columns[i])[row];
    add(seconds(recording.times()[row]));
  }
  return series;
}

double Metric::reduce(const Term& term, const Numbers& series, double from) {
  const auto& x = series.numbers;
  if (term.function == Function::count) return static_cast<double>(x.size());
  if (x.empty() || std::any_of(x.begin(), x.end(), [](double v) { return std::isnan(v); })) return nothing;
  const auto n = static_cast<double>(x.size());
  switch (term.function) {
    case Function::max:
      return *std::max_element(x.begin(), x.end());
    case Function::min:
      return *std::min_element(x.begin(), x.end());
    case Function::mean:
      return std::accumulate(x.begin(), x.end(), 0.0) / n;
    case Function::rms:
      return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0) / n);
    case Function::sd:
      return x.size() < 2 ? nothing : report::statistics(x)[3];
    case Function::settling:
    case Function::count:
      break;
  }
  for (std::size_t i = x.size(); i > 0; --i) {
    if (std::abs(x[i - 1]) <= term.band) continue;
    return series.times[std::min(i, x.size() - 1)] - from;
  }
  return 0;
}

bool Metric::needs_loop() const { return !figures_.empty(); }

double Metric::value(const loop::Recording& recording, Time from, const LoopFigures& loop) {
  for (auto& figure : figures_) {
    figure.number = loop.*figure.figure;
    if (std::isnan(figure.number)) return nothing;
  }
  for (auto& term : terms_) {
    term.result = reduce(term, series_of(term, recording, from), seconds(from));
    if (std::isnan(term.result)) return nothing;
  }
  return number_of(*formula_);
}

}  // namespace drycut::sim::studies
