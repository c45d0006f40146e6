#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
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

/// The bound at one point of an envelope, found in rounds: asks for rows at values(), is given them by
/// take(), until nothing is asked.
class Seeker {
 public:
  explicit Seeker(const BoundRequest& request) : request_(request) { scan(); }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  /// The rows at values(), in their order.
  void take(std::vector<PointRow> rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) seen_.insert_or_assign(values_[i], std::move(rows[i]));
    values_.clear();
    const auto [least, end] = first_stretch();
    if (least == seen_.end()) {
      if (intervals_ == most_intervals) return;
      intervals_ *= 2;
      return scan();
    }
    const double bound = std::prev(end)->first;
    if (end != seen_.end()) ask_between(bound, end->first, request_.tolerance);
    if (!values_.empty()) return;
    const double widest = widest_share * (request_.parameter.high - request_.parameter.low);
    for (auto upper = std::next(least); upper != end; ++upper) {
      const double lower = std::prev(upper)->first;
      const double close = std::min(widest, distance_share * (bound - lower));
      ask_between(lower, upper->first, std::max(request_.tolerance, close));
    }
  }

  [[nodiscard]] Bound bound() const {
    const auto [least, end] = first_stretch();
    Bound bound{Bound::Kind::nowhere, no_bound, no_bound, {}, {}, {}, {}, {}};
    for (const auto& [value, row] : seen_) bound.looks.push_back({value, holds(row)});
    if (least == seen_.end()) {
      bound.limit = seen_.begin()->second.limit;
      return bound;
    }
    const auto& [value, row] = *std::prev(end);
    bound.kind = end == seen_.end() ? Bound::Kind::throughout : Bound::Kind::found;
    bound.value = value;
    bound.from = least->first;
    bound.numbers = row.numbers;
    if (end == seen_.end()) return bound;
    bound.limit = end->second.limit;
    for (auto fails = end; fails != seen_.end();) {
      const auto held = std::find_if(fails, seen_.end(), holds_at);
      if (held == seen_.end()) break;
      if (!bound.again) bound.again = held->first;
      bound.gaps.emplace_back(fails->first, std::prev(held)->first);
      fails = std::find_if_not(held, seen_.end(), holds_at);
    }
    return bound;
  }

 private:
  using Seen = std::map<double, PointRow>;
  static bool holds_at(const Seen::value_type& look) { return holds(look.second); }

  /// From the least value that holds, and behind the last that holds as all between them do.
  [[nodiscard]] std::pair<Seen::const_iterator, Seen::const_iterator> first_stretch() const {
    const auto least = std::find_if(seen_.begin(), seen_.end(), holds_at);
    return {least, std::find_if_not(least, seen_.end(), holds_at)};
  }

  void scan() {
    const auto& [low, high] = std::pair(request_.parameter.low, request_.parameter.high);
    for (int i = 0; i <= intervals_; ++i) {
      const double value = rounded(low + i * (high - low) / intervals_);
      if (!seen_.contains(value) && (values_.empty() || values_.back() < value)) values_.push_back(value);
    }
  }

  /// In the middle of two values, if they are further apart than `closest`.
  void ask_between(double lower, double upper, double closest) {
    if (upper - lower <= closest) return;
    const double half = lower + (upper - lower) / 2;
    const double middle = rounded(request_.parameter.integer ? std::floor(half) : half);
    if (middle > lower && middle < upper) values_.push_back(middle);
  }

  /// As it stands in a row.
  [[nodiscard]] double rounded(double value) const {
    return std::stod(number_text(request_.parameter.integer ? std::rint(value) : value));
  }

  const BoundRequest& request_;
  int intervals_ = scanned_values - 1;
  Seen seen_;
  std::vector<double> values_;
};

/// How many runs a point takes, about.
double runs_expected(const BoundRequest& request) {
  const double width = request.parameter.high - request.parameter.low;
  const double halvings = std::log2(std::max(2.0, width / (scanned_values - 1) / request.tolerance));
  return scanned_values + halvings + std::log(width / request.tolerance) / distance_share;
}

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

void seek(Envelope& envelope, PointStore& store, const StudyProgress& progress) {
  const auto& parameter = envelope.request.parameter;
  std::vector<Seeker> seekers(envelope.points.size(), Seeker(envelope.request));
  const auto expected =
      static_cast<std::size_t>(runs_expected(envelope.request)) * std::max<std::size_t>(1, seekers.size());
  for (std::size_t done = 0;;) {
    std::vector<std::vector<scenario::Override>> asked;
    for (std::size_t i = 0; i < seekers.size(); ++i) {
      for (const double value : seekers[i].values()) {
        asked.push_back(overrides_of(envelope.axes, envelope.points[i]));
        asked.back().push_back({parameter.path, value_text(parameter, value)});
      }
    }
    if (asked.empty()) break;
    const auto in_all = std::max(expected, done + asked.size());
    auto rows = store.rows(envelope.question, asked,
                           [&](std::size_t now, std::size_t) { progress(done + now, in_all); });
    done += rows.size();
    auto next = std::make_move_iterator(rows.begin());
    for (auto& seeker : seekers) {
      const auto count = static_cast<std::ptrdiff_t>(seeker.values().size());
      if (count == 0) continue;
      seeker.take({next, next + count});
      next += count;
    }
  }
  envelope.bounds.clear();
  envelope.bounds.reserve(seekers.size());
  for (const auto& seeker : seekers) envelope.bounds.push_back(seeker.bound());
}

std::string_view why_again(const std::vector<Envelope>& envelopes) {
  for (const auto& envelope : envelopes)
    for (const auto& bound : envelope.bounds)
      if (bound.again)
        return "what holds again beyond its bound may be a round speed: the measuring wheel gives whole "
               "counts a sampling there, and the loop is quieter than beside it (drycut help maximum_speed)";
  return "";
}

namespace {

/// "115..121.875; 140": where it fails though it holds again behind.
std::string gaps_cell(const Bound& bound) {
  std::string text;
  for (const auto& [from, to] : bound.gaps) {
    if (!text.empty()) text += "; ";
    text += from == to ? number_cell(from) : fmt::format("{}..{}", number_cell(from), number_cell(to));
  }
  return text;
}

using Cell = std::pair<std::string, std::string>;  // heading and what stands under it
std::vector<Cell> cells_of(const Envelope& envelope, std::size_t point) {
  const auto& bound = envelope.bounds[point];
  const auto& sought = envelope.request.parameter;
  const auto unit = sought.unit.empty() ? "" : fmt::format(" [{}]", sought.unit);
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < envelope.axes.size(); ++i)
    cells.emplace_back(heading(envelope.axes[i].parameter), csv_cell(envelope.points[point][i]));
  cells.emplace_back(heading(sought), number_cell(bound.value));
  cells.emplace_back("verdict", name_of(bound.kind));
  cells.emplace_back("limit", csv_cell(bound.limit));
  cells.emplace_back("holds from" + unit, number_cell(bound.from));
  cells.emplace_back("fails at" + unit, gaps_cell(bound));
  cells.emplace_back("holds again at" + unit, number_cell(bound.again.value_or(no_bound)));
  const auto& columns = envelope.question.columns;
  for (std::size_t k = 0; k < columns.size(); ++k)
    cells.emplace_back(columns[k], k < bound.numbers.size() ? number_cell(bound.numbers[k]) : "");
  return cells;
}

}  // namespace

std::string envelope_csv(const std::vector<Envelope>& envelopes) {
  std::vector<std::string> headings;
  for (const auto& envelope : envelopes)
    for (const auto& [name, text] : cells_of(envelope, 0))
      if (std::find(headings.begin(), headings.end(), name) == headings.end()) headings.push_back(name);
  const bool several = envelopes.size() > 1;
  std::string text = several ? "scene" : "";
  for (const auto& name : headings) text += (text.empty() ? "" : ",") + csv_cell(name);
  text += "\n";
  for (const auto& envelope : envelopes) {
    for (std::size_t i = 0; i < envelope.points.size(); ++i) {
      const auto cells = cells_of(envelope, i);
      if (several) text += csv_cell(envelope.scene) + ",";
      for (const auto& name : headings) {
        const auto found =
            std::find_if(cells.begin(), cells.end(), [&](const Cell& cell) { return cell.first == name; });
        text += (&name == &headings.front() ? "" : ",") + (found == cells.end() ? "" : found->second);
      }
      text += "\n";
    }
  }
  return text;
}

}  // namespace drycut::sim::studies
