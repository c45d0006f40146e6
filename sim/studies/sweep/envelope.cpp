#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "base/text.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double no_bound = std::numeric_limits<double>::quiet_NaN();
constexpr double default_share = 200;  // of the range
constexpr int most_intervals = 32;     // looked at where nothing holds

bool holds(const PointRow& row) { return row.verdict == PointRow::Verdict::passed; }

/// The bound at one point of the envelope, found in rounds: asks for rows at values(), is given them by
/// take(), until nothing is asked.
class Seeker {
 public:
  explicit Seeker(const TunedParameter& parameter, double tolerance)
      : parameter_(parameter), tolerance_(tolerance) {
    scan();
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] const Bound& bound() const { return bound_; }

  /// The rows at values(), in their order.
  void take(std::vector<PointRow> rows) {
    if (beyond_) {
      halve(std::move(rows.front()));
    } else if (std::any_of(rows.begin(), rows.end(), holds)) {
      bound_of(rows);
    } else if (intervals_ < most_intervals) {
      intervals_ *= 2;
      return scan();
    } else {
      bound_ = {Bound::Kind::nowhere, no_bound, no_bound, {}, rows.front().limit, {}};
    }
    values_.clear();
    if (!beyond_ || *beyond_ - bound_.value <= tolerance_) return;
    const double half = bound_.value + (*beyond_ - bound_.value) / 2;
    const double middle = std::stod(number_text(parameter_.integer ? std::floor(half) : half));
    if (middle > bound_.value && middle < *beyond_) values_ = {middle};
  }

 private:
  void scan() {
    values_.clear();
    for (int i = 0; i <= intervals_; ++i) {
      const double value = parameter_.low + i * (parameter_.high - parameter_.low) / intervals_;
      values_.push_back(std::stod(number_text(parameter_.integer ? std::rint(value) : value)));
    }
  }

  void bound_of(const std::vector<PointRow>& rows) {
    const auto first = static_cast<std::size_t>(std::find_if(rows.begin(), rows.end(), holds) - rows.begin());
    auto end = first;
    while (end < rows.size() && holds(rows[end])) ++end;
    if (end == rows.size()) {
      bound_ = {Bound::Kind::throughout, values_.back(), values_[first], {}, "", rows.back().numbers};
      return;
    }
    bound_ = {Bound::Kind::found, values_[end - 1],     values_[first], {},
              rows[end].limit,    rows[end - 1].numbers};
    for (std::size_t i = rows.size(); i-- > end;)
      if (holds(rows[i])) bound_.again = values_[i];
    beyond_ = values_[end];
  }

  // What holds at bound_.value does not at *beyond_.
  void halve(PointRow row) {
    if (holds(row)) {
      bound_.value = values_.front();
      bound_.numbers = std::move(row.numbers);
    } else {
      beyond_ = values_.front();
      bound_.limit = std::move(row.limit);
    }
  }

  const TunedParameter& parameter_;
  double tolerance_;
  int intervals_ = scanned_values - 1;
  std::vector<double> values_;
  std::optional<double> beyond_;
  Bound bound_;
};

std::string number_cell(double number) { return std::isnan(number) ? "" : fmt::format("{:.9g}", number); }

}  // namespace

std::string_view name_of(Bound::Kind kind) {
  constexpr std::array<std::string_view, 3> names = {"found", "throughout", "nowhere"};
  return names.at(static_cast<std::size_t>(kind));
}

std::optional<BoundRequest> parse_bound(const std::string& text, const std::string& option,
                                        Problems& problems) {
  const auto colon = text.find(':', std::min(text.find(".."), text.size()));
  const auto range = text.substr(0, colon);
  auto parameter = parse_parameter(range, option, false, problems);
  if (!parameter) return {};
  BoundRequest request{std::move(*parameter), 0};
  const double width = request.parameter.high - request.parameter.low;
  request.tolerance = width / default_share;
  if (colon == std::string::npos) return request;
  const auto given = scenario::parse_quantity(text.substr(colon + 1));
  const bool fits = given && (given->unit.empty() || given->unit == request.parameter.unit);
  if (fits && given->number > 0 && given->number < width) {
    request.tolerance = given->number;
    return request;
  }
  problems.push_back({option, 1, static_cast<int>(colon) + 2,
                      fmt::format("'{}' is no tolerance", text.substr(colon + 1)),
                      fmt::format("above 0 and less than the range of {:.6g}, in its unit: :{:.3g}", width,
                                  request.tolerance)});
  return {};
}

std::vector<Bound> envelope(const PointQuestion& question, const SweepAxes& axes,
                            const std::vector<SweepPoint>& points, const BoundRequest& request,
                            PointStore& store, const StudyProgress& progress) {
  const auto& parameter = request.parameter;
  std::vector<Seeker> seekers(points.size(), Seeker(parameter, request.tolerance));
  const double halvings =
      std::ceil(std::log2((parameter.high - parameter.low) / (scanned_values - 1) / request.tolerance));
  const auto runs = points.size() * static_cast<std::size_t>(scanned_values + std::max(0.0, halvings));
  for (std::size_t done = 0;;) {
    std::vector<std::vector<scenario::Override>> asked;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const double value : seekers[i].values()) {
        asked.push_back(overrides_of(axes, points[i]));
        asked.back().push_back({parameter.path, value_text(parameter, value)});
      }
    }
    if (asked.empty()) break;
    auto rows =
        store.rows(question, asked, [&](std::size_t now, std::size_t) { progress(done + now, runs); });
    done += rows.size();
    auto next = std::make_move_iterator(rows.begin());
    for (auto& seeker : seekers) {
      const auto count = static_cast<std::ptrdiff_t>(seeker.values().size());
      if (count == 0) continue;
      seeker.take({next, next + count});
      next += count;
    }
  }
  std::vector<Bound> bounds;
  bounds.reserve(seekers.size());
  for (const auto& seeker : seekers) bounds.push_back(seeker.bound());
  return bounds;
}

std::string envelope_csv(const PointQuestion& question, const SweepAxes& axes,
                         const std::vector<SweepPoint>& points, const BoundRequest& request,
                         const std::vector<Bound>& bounds) {
  const auto& parameter = request.parameter;
  const auto unit = parameter.unit.empty() ? "" : fmt::format(" [{}]", parameter.unit);
  auto text = csv_heading(
      question, axes,
      fmt::format("{},verdict,limit,holds from{},holds again at{}", heading(parameter), unit, unit));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& bound = bounds[i];
    for (const auto& value : points[i]) text += value + ",";
    text +=
        fmt::format("{},{},{},{},{}", number_cell(bound.value), name_of(bound.kind), csv_cell(bound.limit),
                    number_cell(bound.from), number_cell(bound.again.value_or(no_bound)));
    for (std::size_t k = 0; k < question.columns.size(); ++k)
      text += "," + (k < bound.numbers.size() ? number_cell(bound.numbers[k]) : "");
    text += "\n";
  }
  return text;
}

}  // namespace drycut::sim::studies
