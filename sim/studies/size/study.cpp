#include "sim/studies/size/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/text.hpp"
#include "sim/studies/size/needs.hpp"
#include "sim/studies/sweep/axis.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double no_share = std::numeric_limits<double>::quiet_NaN();
constexpr double whole_percent = 100;
constexpr double nearly_all = 0.9;  // of the cycles that a motor without limits comes to
constexpr std::string_view of_ratings = "drive within its ratings";  // the check that says so

/// The bus is counted from where the brake resistor holds it: up to there nothing is used up.
double used_share(const Candidate& candidate, std::size_t rating, double share) {
  static const auto bus = rating_index("DC link above rectified mains");
  if (rating != bus || candidate.braked_share >= 1) return share;
  return std::max(0.0, (share - candidate.braked_share) / (1 - candidate.braked_share));
}

/// The run has come to what a motor's figures are: machine cycles, a steady one among them, and no trip.
bool has_figures(const RatedDrive& drive) { return drive.cycles > 0 && drive.steady > 0 && drive.trips == 0; }

bool has_run(const PointRow& row) {
  return row.verdict == PointRow::Verdict::passed || row.verdict == PointRow::Verdict::failed;
}

/// A candidate's run at a corner, and the run there with a motor without limits.
struct CornerRun {
  const PointRow& row;
  const PointRow* unlimited = nullptr;
};

/// The worst rating: measured, or needed.
struct Shortage {
  double share = 0;  ///< of what it may be, 1 = all
  std::size_t rating = 0;
};

/// What came of a candidate at one corner.
class CornerJudge {
 public:
  CornerJudge(const PointQuestion& question, const Candidate& candidate, const CornerRun& run)
      : question_(question), candidate_(candidate), run_(run), drive_(rated_drive(run.row.numbers)) {
    if (run.unlimited == nullptr || !has_run(*run.unlimited)) return;
    const auto unlimited = rated_drive(run.unlimited->numbers);
    if (!has_figures(unlimited)) return;
    // Where a check fails all the same, its steady cycle says what is needed, and peaks may be of a crash.
    needs_ = needs_of(unlimited, candidate.ratings, holds_without_limits());
    stopped_ = drive_.cycles < nearly_all * unlimited.cycles;
  }

  [[nodiscard]] const RatedDrive& drive() const { return drive_; }
  /// It ran to the end.
  [[nodiscard]] bool is_measured() const { return has_figures(drive_) && !stopped_; }

  /// Of what the motor needs, where that is too much for it, for only that can be compared with what another
  /// one needs; else of all. Nothing if neither run says.
  [[nodiscard]] std::optional<Shortage> shortage() const {
    if (!is_measured() && !needs_) return {};
    Shortage needed;
    Shortage used;
    for (std::size_t i = 0; i < ratings.size(); ++i) {
      if (needs_ && (*needs_)[i].share > needed.share) needed = {(*needs_)[i].share, i};
      const double share = used_share(candidate_, i, drive_.figures[i].share);
      if ((is_measured() || !ratings[i].mean) && share > used.share) used = {share, i};
    }
    return needed.share > 1 || used.share < needed.share ? needed : used;
  }

  /// What does not hold; "" if all does. Of a run that ended early no means, which are of another work.
  [[nodiscard]] std::string fault() const {
    std::vector<std::string> faults;
    const auto verdict = run_.row.verdict;
    const auto& limit = run_.row.limit;
    const bool failed = verdict == PointRow::Verdict::failed;
    if (failed && limit != of_ratings)
      faults.push_back(fmt::format("check '{}' failed{}", limit,
                                   fails_without_limits() ? " (with a motor without limits, too)" : ""));
    if (drive_.trips > 0)
      faults.push_back(drive_.trips > 1 ? fmt::format("the drive tripped {:.0f} times", drive_.trips)
                                        : "the drive tripped");
    std::vector<std::pair<double, std::string>> over;
    for (std::size_t i = 0; i < ratings.size(); ++i) {
      const auto& figure = drive_.figures[i];
      if (figure.share > 1 && (is_measured() || !ratings[i].mean))
        over.emplace_back(-figure.share, figure_text(i, figure));
    }
    std::stable_sort(over.begin(), over.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [share, text] : over) faults.push_back(std::move(text));
    auto text = fmt::format("{}", fmt::join(faults, "; "));
    const auto early = end_text();
    text += text.empty() || early.empty() ? early : " and " + early;
    if (!is_measured()) text += ", so its continuous load is unknown";
    if (text.empty() && failed) text = fmt::format("check '{}' failed: another drive of the line", limit);
    if (!text.empty()) text += need_text();
    return text;
  }

 private:
  static std::string figure_text(std::size_t rating, const RatedDrive::Figure& figure) {
    return fmt::format("{} {:.3g} {} ({:.0f} %)", ratings[rating].name, figure.value, ratings[rating].unit,
                       whole_percent * figure.share);
  }

  [[nodiscard]] bool holds_without_limits() const {
    const auto verdict = run_.unlimited->verdict;
    const auto& limit = run_.unlimited->limit;
    return verdict == PointRow::Verdict::passed ||
           (verdict == PointRow::Verdict::failed && limit == of_ratings);
  }
  [[nodiscard]] bool fails_without_limits() const {
    return run_.unlimited != nullptr && run_.unlimited->verdict == PointRow::Verdict::failed &&
           run_.unlimited->limit == run_.row.limit;
  }

  /// What is missing of machine cycles.
  [[nodiscard]] std::string end_text() const {
    if (drive_.cycles <= 0) return no_cycle();
    if (stopped_)
      return fmt::format("the run ended early, after {}",
                         counted(std::lround(drive_.cycles), "machine cycle"));
    return drive_.steady > 0 ? "" : "no steady machine cycle was found: let the scenario run for longer";
  }
  /// Why no machine cycle has ended.
  [[nodiscard]] std::string no_cycle() const {
    const auto plant = question_.rated.substr(0, question_.rated.find('.'));
    const auto cuts = Table(question_.columns).find(piece_key(plant, "number"));
    if (!cuts) return "no machine cycle ended";
    const auto piece = std::find_if(question_.pieces.begin(), question_.pieces.end(),
                                    [&](const auto& known) { return known.source == plant; });
    const auto since = piece->from > 0 ? fmt::format(" from {:g} s on", piece->from) : std::string();
    const double pieces = run_.row.numbers.at(*cuts);
    return pieces > 0 ? fmt::format("of {} cut{} none was a machine cycle",
                                    counted(std::lround(pieces), "piece"), since)
                      : fmt::format("no piece was cut{}", since);
  }

  [[nodiscard]] std::string need_text() const {
    if (!needs_) {
      const bool fails = run_.unlimited != nullptr && run_.unlimited->verdict == PointRow::Verdict::failed;
      if (!fails || is_measured() || fails_without_limits()) return "";
      return fmt::format("; with a motor without limits check '{}' fails", run_.unlimited->limit);
    }
    std::size_t worst = 0;
    for (std::size_t i = 0; i < ratings.size(); ++i)
      if ((*needs_)[i].share > (*needs_)[worst].share) worst = i;
    const bool told = drive_.figures[worst].share >= 0.98 * (*needs_)[worst].share;
    if ((*needs_)[worst].share <= 1 || told) return "";
    return "; it would need " + figure_text(worst, (*needs_)[worst]);
  }

  const PointQuestion& question_;
  const Candidate& candidate_;
  const CornerRun& run_;
  RatedDrive drive_;
  bool stopped_ = false;  // before as many cycles as a motor without limits comes to
  std::optional<std::array<RatedDrive::Figure, ratings.size()>> needs_;
};

class CandidateJudge {
 public:
  CandidateJudge(const PointQuestion& question, const Candidate& candidate,
                 const std::vector<Corner>& corners)
      : question_(question), candidate_(candidate), corners_(corners) {
    forget();
  }

  Sized without_run() {
    sized_.reason = candidate_.unfit;
    return std::move(sized_);
  }

  /// The runs at all corners.
  Sized run(const std::vector<CornerRun>& runs) {
    bool ran = true;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const auto& row = runs[i].row;
      const auto& corner = corners_[i].name;
      if (!has_run(row)) {
        ran = false;
        sized_.drives.emplace_back();
        add_fault(fmt::format("{}: {}", name_of(row.verdict), row.limit), {}, corner);
        continue;
      }
      const CornerJudge judge(question_, candidate_, runs[i]);
      if (judge.is_measured())
        take(judge.drive(), corner);
      else
        sized_.drives.emplace_back();
      if (const auto fault = judge.fault(); !fault.empty()) add_fault(fault, judge.shortage(), corner);
    }
    const bool measured =
        std::all_of(sized_.drives.begin(), sized_.drives.end(), [](const auto& drive) { return drive; });
    if (!measured) forget();
    auto& distance = sized_.distance;
    if (distance.corners > 1)
      sized_.where += " and " + counted(static_cast<std::int64_t>(distance.corners) - 1, "more corner");
    using Kind = Sized::Kind;
    sized_.kind = !ran                             ? Kind::ruled_out
                  : distance.corners > 0           ? Kind::does_not_fit
                  : sized_.reserve >= good_reserve ? Kind::fits
                                                   : Kind::close;
    return std::move(sized_);
  }

 private:
  /// What is used, over all corners, is not known.
  void forget() {
    sized_.reserve = sized_.energy = no_share;
    sized_.shares.fill(no_share);
    sized_.nearest.clear();
    sized_.hardest.clear();
  }

  void take(const RatedDrive& drive, const std::string& corner) {
    for (std::size_t i = 0; i < ratings.size(); ++i) {
      const double share = drive.figures[i].share;
      if (std::isnan(share)) continue;
      sized_.shares[i] = std::fmax(sized_.shares[i], whole_percent * share);
      const double left = whole_percent * (1 - used_share(candidate_, i, share));
      if (!std::isnan(sized_.reserve) && left >= sized_.reserve) continue;
      sized_.reserve = left;
      sized_.nearest = ratings[i].name;
      sized_.hardest = corner;
    }
    sized_.energy = std::fmax(sized_.energy, drive.energy);
    sized_.drives.emplace_back(drive);
  }

  /// Of several the one that is farthest from fitting is told.
  void add_fault(const std::string& fault, const std::optional<Shortage>& shortage,
                 const std::string& corner) {
    auto& distance = sized_.distance;
    const double share = shortage ? shortage->share : std::numeric_limits<double>::infinity();
    if (distance.corners++ == 0 || share > worst_) {
      worst_ = share;
      sized_.reason = fault;
      sized_.where = corner;
    }
    if (!shortage) {
      ++distance.unknown;
      return;
    }
    const double short_by = whole_percent * (shortage->share - 1);
    if (short_by <= distance.short_by) return;
    distance.short_by = short_by;
    distance.rating = ratings[shortage->rating].name;
    distance.corner = corner;
  }

  const PointQuestion& question_;
  const Candidate& candidate_;
  const std::vector<Corner>& corners_;
  Sized sized_;
  double worst_ = 0;  // share at the corner that is told
};

}  // namespace

std::string_view name_of(Sized::Kind kind) {
  constexpr std::array<std::string_view, 4> names = {"fits", "fits closely", "does not fit", "ruled out"};
  return names.at(static_cast<std::size_t>(kind));
}

std::vector<Sized> size_drives(const PointQuestion& question, const SizedDrive& drive,
                               const std::vector<Candidate>& candidates, const std::vector<Corner>& corners,
                               PointStore& store, const StudyProgress& progress) {
  using Overrides = std::vector<scenario::Override>;
  const auto limitless = without_limits(drive);
  std::vector<Overrides> asked;
  std::vector<Overrides> asked_without_limits;  // of each of `asked`
  asked.reserve(candidates.size() * corners.size());
  for (const auto& candidate : candidates) {
    if (!candidate.unfit.empty()) continue;
    for (const auto& corner : corners) {
      asked.push_back(candidate.overrides);
      auto& unlimited = asked_without_limits.emplace_back(candidate.overrides);
      unlimited.insert(unlimited.end(), limitless.begin(), limitless.end());
      for (auto* one : {&asked.back(), &unlimited})
        one->insert(one->end(), corner.overrides.begin(), corner.overrides.end());
    }
  }
  const auto rows = store.rows(question, asked, progress);
  std::vector<Overrides> again;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool holds =
        rows[i].verdict == PointRow::Verdict::passed && has_figures(rated_drive(rows[i].numbers));
    if (holds || !has_run(rows[i]) || limitless.empty()) continue;
    again.push_back(std::move(asked_without_limits[i]));
    which.push_back(i);
  }
  const auto unlimited = store.rows(question, again, progress);
  std::vector<CornerRun> runs;
  for (const auto& row : rows) runs.push_back({row});
  for (std::size_t i = 0; i < which.size(); ++i) runs[which[i]].unlimited = &unlimited[i];

  std::vector<Sized> sized;
  sized.reserve(candidates.size());
  auto next = runs.begin();
  for (const auto& candidate : candidates) {
    CandidateJudge judge(question, candidate, corners);
    if (!candidate.unfit.empty()) {
      sized.push_back(judge.without_run());
      continue;
    }
    const auto end = next + std::ssize(corners);
    sized.push_back(judge.run({next, end}));
    next = end;
  }
  return sized;
}

std::vector<std::size_t> ranked(const std::vector<Candidate>& candidates, const std::vector<Sized>& sized) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    const auto& one = sized[i];
    const auto& candidate = candidates[i];
    const bool good = one.kind == Sized::Kind::fits || one.kind == Sized::Kind::close;
    const bool out = one.kind == Sized::Kind::ruled_out;
    constexpr double last = std::numeric_limits<double>::infinity();
    return std::tuple(one.kind, good ? candidate.rated_power : 0, good ? candidate.resistor_power : 0,
                      one.distance.unknown, one.distance.short_by, one.distance.corners,
                      good && !std::isnan(one.reserve) ? -one.reserve : 0,
                      good && !std::isnan(one.energy) ? one.energy : 0,
                      !out                       ? 0
                      : candidate.is_too_heavy() ? candidate.inertia_ratio / candidate.most_inertia_ratio
                                                 : last);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

Table size_table(const std::vector<Candidate>& candidates, const std::vector<Sized>& sized,
                 const std::vector<std::size_t>& order) {
  constexpr int rated = 6;
  constexpr int all = 15;  // as the command line takes it
  std::vector<Column> columns = {{"rank", "rank"},
                                 {"verdict", "verdict"},
                                 {"motor", "motor"},
                                 {"motor_values", "motor values"},
                                 {"rated_power", "rated power", "kW", rated},
                                 {"gear_ratio", "gear ratio", "", all},
                                 {"gear_values", "other values of the gear"},
                                 {"brake_resistor", "brake resistor"},
                                 {"reserve", "reserve", "%"},
                                 {"nearest_limit", "nearest limit"},
                                 {"at", "at"},
                                 {"short_by", "short by", "%"},
                                 {"short_of", "short of"},
                                 {"short_at", "short at"},
                                 {"inertia_ratio", "inertia ratio", "", rated},
                                 {"most_inertia_ratio", "inertia ratio at most", "", rated}};
  for (std::size_t i = 0; i < ratings.size(); ++i)
    columns.push_back({fmt::format("share.{}", i), std::string(ratings[i].name), "% of its rating"});
  columns.insert(
      columns.end(),
      {{"energy", "energy a cycle", "J"}, {"reason", "reason"}, {"where", "where"}, {"set", "set"}});
  Table table(std::move(columns));
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto& candidate = candidates[order[rank]];
    const auto& one = sized[order[rank]];
    const auto& distance = one.distance;
    const bool has_gear = candidate.ratio > 0;
    const bool is_short = one.kind == Sized::Kind::does_not_fit && distance.unknown == 0;
    std::vector<Table::Cell> cells = {
        static_cast<double>(rank + 1),
        std::string(name_of(one.kind)),
        candidate.motor,
        candidate.values,
        candidate.rated_power / 1e3,
        has_gear ? candidate.ratio : no_share,
        !has_gear                     ? ""
        : candidate.gear_kind.empty() ? "as in the scenario"
                                      : fmt::format("{}; the rest as in the scenario", candidate.gear_kind),
        candidate.resistor.text,
        one.reserve,
        one.nearest,
        one.hardest,
        is_short ? distance.short_by : no_share,
        distance.rating,
        distance.corner,
        candidate.inertia_ratio,
        std::isfinite(candidate.most_inertia_ratio) ? candidate.most_inertia_ratio : no_share};
    cells.insert(cells.end(), one.shares.begin(), one.shares.end());
    std::vector<std::string> set;
    for (const auto& [path, value] : candidate.overrides) set.push_back(fmt::format("{}={}", path, value));
    cells.insert(cells.end(), {one.energy, one.reason, one.where, fmt::format("{}", fmt::join(set, "; "))});
    table.add(std::move(cells));
  }
  return table;
}

}  // namespace drycut::sim::studies
