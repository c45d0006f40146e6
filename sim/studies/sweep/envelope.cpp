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
/// take(), until nothing is asked. A smallest value is the largest of those with the other sign: that is how
/// it goes on inside.
class Seeker {
 public:
  explicit Seeker(const BoundRequest& request)
      : request_(request),
        low_(request.least ? -request.parameter.high : request.parameter.low),
        width_(request.parameter.high - request.parameter.low),
        step_(warranted_step(request.tolerance)) {
    scan();
  }

  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  /// The rows at values(), in their order. A value that is refused may have too many digits for a whole
  /// number of the controller: it is asked for once more in those that the tolerance warrants.
  void take(std::vector<PointRow> rows) {
    std::vector<double> again;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double plain = rounded(std::rint(values_[i] / step_) * step_);
      const bool new_one = plain != values_[i] && !seen_.contains(turned(plain)) &&
                           plain >= request_.parameter.low && plain <= request_.parameter.high &&
                           std::find(again.begin(), again.end(), plain) == again.end();
      if (rows[i].verdict == PointRow::Verdict::refused && new_one)
        again.push_back(plain);
      else
        seen_.insert_or_assign(turned(values_[i]), std::move(rows[i]));
    }
    values_ = std::move(again);
    if (!values_.empty()) return;
    const auto [least, end] = first_stretch();
    if (least == seen_.end()) {
      if (intervals_ == most_intervals) return;
      intervals_ *= 2;
      return scan();
    }
    const double bound = std::prev(end)->first;
    if (end != seen_.end()) ask_between(bound, end->first, request_.tolerance);
    if (!values_.empty()) return;
    const double widest = widest_share * width_;
    for (auto upper = std::next(least); upper != end; ++upper) {
      const double lower = std::prev(upper)->first;
      const double close = std::min(widest, distance_share * (bound - lower));
      ask_between(lower, upper->first, std::max(request_.tolerance, close));
    }
  }

  [[nodiscard]] Bound bound() const {
    const auto [least, end] = first_stretch();
    Bound bound{Bound::Kind::nowhere, no_bound, no_bound, {}, {}, {}, {}, {}};
    for (const auto& [value, row] : seen_) bound.looks.push_back({turned(value), row.verdict});
    if (request_.least) std::reverse(bound.looks.begin(), bound.looks.end());
    if (least == seen_.end()) {
      const auto ran = std::find_if(seen_.begin(), seen_.end(), [](const auto& look) {
        return look.second.verdict != PointRow::Verdict::refused;
      });
      bound.beyond = (ran == seen_.end() ? seen_.begin() : ran)->second;
      return bound;
    }
    const auto& [value, row] = *std::prev(end);
    bound.kind = end == seen_.end() ? Bound::Kind::throughout : Bound::Kind::found;
    bound.value = turned(value);
    bound.from = turned(least->first);
    bound.numbers = row.numbers;
    if (end == seen_.end()) return bound;
    bound.beyond = end->second;
    for (auto fails = end; fails != seen_.end();) {
      const auto held = std::find_if(fails, seen_.end(), holds_at);
      if (held == seen_.end()) break;
      if (!bound.again) bound.again = turned(held->first);
      bound.gaps.emplace_back(turned(fails->first), turned(std::prev(held)->first));
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
    for (int i = 0; i <= intervals_; ++i) {
      const double value = rounded(low_ + i * width_ / intervals_);
      if (!seen_.contains(value) && (values_.empty() || turned(values_.back()) < value))
        values_.push_back(turned(value));
    }
  }

  /// From outside to inside and back; 0 has no sign.
  [[nodiscard]] double turned(double value) const { return request_.least && value != 0 ? -value : value; }

  /// In the middle of two values, if they are further apart than `closest`.
  void ask_between(double lower, double upper, double closest) {
    if (upper - lower <= closest) return;
    const double half = lower + (upper - lower) / 2;
    const double middle = rounded(request_.parameter.integer ? std::floor(half) : half);
    if (middle > lower && middle < upper) values_.push_back(turned(middle));
  }

  /// As it stands in a row.
  [[nodiscard]] double rounded(double value) const {
    return std::stod(number_text(request_.parameter.integer ? std::rint(value) : value));
  }

  const BoundRequest& request_;
  double low_;
  double width_;
  double step_;
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

double warranted_step(double tolerance) { return std::pow(10, std::floor(std::log10(tolerance))); }

std::optional<BoundRequest> parse_bound(const std::string& text, const std::string& option, bool least,
                                        Problems& problems) {
  const auto colon = text.find(':', std::min(text.find(".."), text.size()));
  const auto range = text.substr(0, colon);
  auto parameter = parse_parameter(range, option, false, problems);
  if (!parameter) return {};
  BoundRequest request{std::move(*parameter), 0, least};
  const double width = request.parameter.high - request.parameter.low;
  request.tolerance = width / default_share;
  if (colon == std::string::npos) return request;
  const auto given = scenario::parse_quantity(text.substr(colon + 1));
  const bool fits = given && (given->unit.empty() || given->unit == request.parameter.unit);
  if (fits && given->number > 0 && given->number < width) {
    request.tolerance = given->number;
    return request;
  }
  problems.push_back({"study.out-of-range"_code, option, 1, static_cast<int>(colon) + 2,
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
  for (const auto& gap : bound.gaps) {
    const auto [low, high] = std::minmax(gap.first, gap.second);
    if (!text.empty()) text += "; ";
    text += low == high ? number_cell(low) : fmt::format("{}..{}", number_cell(low), number_cell(high));
  }
  return text;
}

Table table_of(const Envelope& envelope, const std::string& scene) {
  const auto& sought = envelope.request.parameter;
  auto columns = columns_of(envelope.axes);
  if (!scene.empty()) columns.insert(columns.begin(), {"scene", "scene"});
  const char* holds = envelope.request.least ? "holds to" : "holds from";
  columns.insert(columns.end(), {column_of(sought),
                                 {"verdict", "verdict"},
                                 {"limit", "limit"},
                                 {"rating", "rating"},
                                 {holds, holds, sought.unit},
                                 {"fails at", "fails at", sought.unit},
                                 {"holds again at", "holds again at", sought.unit}});
  columns.insert(columns.end(), envelope.question.columns.begin(), envelope.question.columns.end());
  Table table(std::move(columns));
  for (std::size_t i = 0; i < envelope.points.size(); ++i) {
    const auto& bound = envelope.bounds[i];
    std::vector<Table::Cell> cells;
    if (!scene.empty()) cells.emplace_back(scene);
    cells.insert(cells.end(), envelope.points[i].begin(), envelope.points[i].end());
    cells.emplace_back(bound.value);
    cells.emplace_back(std::string(name_of(bound.kind)));
    cells.emplace_back(bound.beyond.limit);
    cells.emplace_back(bound.beyond.rating);
    cells.emplace_back(bound.from);
    cells.emplace_back(gaps_cell(bound));
    cells.emplace_back(bound.again.value_or(no_bound));
    cells.insert(cells.end(), bound.numbers.begin(), bound.numbers.end());
    table.add(std::move(cells));
  }
  return table;
}

}  // namespace

Table envelope_table(const std::vector<Envelope>& envelopes) {
  const auto scene_of = [&](const Envelope& one) { return envelopes.size() > 1 ? one.scene : ""; };
  auto table = table_of(envelopes.front(), scene_of(envelopes.front()));
  for (std::size_t i = 1; i < envelopes.size(); ++i)
    table.append(table_of(envelopes[i], scene_of(envelopes[i])));
  return table;
}

}  // namespace drycut::sim::studies
