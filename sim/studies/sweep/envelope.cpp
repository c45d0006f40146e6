#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "sim/scenario/units.hpp"
#include "sim/studies/compare/recorded_csv.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double no_bound = std::numeric_limits<double>::quiet_NaN();
constexpr double default_share = 200;  // of the range
constexpr int most_intervals = 32;     // looked at where nothing holds

bool holds(const PointRow& row) { return row.verdict == PointRow::Verdict::passed; }

/// The bound at one point of the envelope.
class Seeker {
 public:
  Seeker(const PointQuestion& question, const SweepAxes& axes, const SweepPoint& point,
         const BoundRequest& request, PointStore& store, const std::function<void()>& ran)
      : question_(question), fixed_(overrides_of(axes, point)), request_(request), store_(store), ran_(ran) {}

  Bound run() {
    std::vector<double> values;
    std::vector<PointRow> rows;
    for (int intervals = scanned_values - 1; intervals <= most_intervals; intervals *= 2) {
      values.clear();
      rows.clear();
      for (int i = 0; i <= intervals; ++i) {
        values.push_back(value_at(static_cast<double>(i) / intervals));
        rows.push_back(at(values.back()));
      }
      if (std::any_of(rows.begin(), rows.end(), holds)) return bound_of(values, rows);
    }
    return {Bound::Kind::nowhere, no_bound, no_bound, {}, rows[0].limit, {}};
  }

 private:
  Bound bound_of(const std::vector<double>& values, const std::vector<PointRow>& rows) {
    const auto first = static_cast<std::size_t>(std::find_if(rows.begin(), rows.end(), holds) - rows.begin());
    auto end = first;
    while (end < rows.size() && holds(rows[end])) ++end;
    if (end == rows.size())
      return {Bound::Kind::throughout, values.back(), values[first], {}, "", rows.back().numbers};
    Bound bound{Bound::Kind::found, values[end - 1],      values[first], {},
                rows[end].limit,    rows[end - 1].numbers};
    for (std::size_t i = rows.size(); i-- > end;)
      if (holds(rows[i])) bound.again = values[i];
    halve(bound, values[end]);
    return bound;
  }

  // What holds at bound.value does not at `beyond`.
  void halve(Bound& bound, double beyond) {
    while (beyond - bound.value > request_.tolerance) {
      const double half = bound.value + (beyond - bound.value) / 2;
      const double middle = std::stod(number_text(request_.parameter.integer ? std::floor(half) : half));
      if (middle <= bound.value || middle >= beyond) return;
      auto row = at(middle);
      if (holds(row)) {
        bound.value = middle;
        bound.numbers = std::move(row.numbers);
      } else {
        beyond = middle;
        bound.limit = std::move(row.limit);
      }
    }
  }

  [[nodiscard]] double value_at(double share) const {
    const auto& parameter = request_.parameter;
    const double value = parameter.low + share * (parameter.high - parameter.low);
    return std::stod(number_text(parameter.integer ? std::rint(value) : value));
  }

  PointRow at(double value) {
    auto overrides = fixed_;
    overrides.push_back({request_.parameter.path, value_text(request_.parameter, value)});
    auto row = store_.row(question_, overrides);
    ran_();
    return row;
  }

  const PointQuestion& question_;
  std::vector<scenario::Override> fixed_;
  const BoundRequest& request_;
  PointStore& store_;
  const std::function<void()>& ran_;
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
                            PointStore& store, int jobs, const StudyProgress& progress) {
  std::vector<Bound> bounds(points.size());
  const double halvings = std::ceil(
      std::log2((request.parameter.high - request.parameter.low) / (scanned_values - 1) / request.tolerance));
  const auto runs = points.size() * static_cast<std::size_t>(scanned_values + std::max(0.0, halvings));
  std::atomic<std::size_t> done = 0;
  const std::function<void()> ran = [&] { progress(++done, runs); };
  for_each_index(points.size(), jobs, [&](std::size_t i) {
    bounds[i] = Seeker(question, axes, points[i], request, store, ran).run();
  });
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
    const auto limit =
        bound.limit.find_first_of(",\"") == std::string::npos ? bound.limit : csv_quoted(bound.limit);
    text += fmt::format("{},{},{},{},{}", number_cell(bound.value), name_of(bound.kind), limit,
                        number_cell(bound.from), number_cell(bound.again.value_or(no_bound)));
    for (std::size_t k = 0; k < question.columns.size(); ++k)
      text += "," + (k < bound.numbers.size() ? number_cell(bound.numbers[k]) : "");
    text += "\n";
  }
  return text;
}

}  // namespace drycut::sim::studies
