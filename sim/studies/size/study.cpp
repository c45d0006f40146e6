#include "sim/studies/size/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/text.hpp"
#include "sim/studies/sweep/axis.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double no_share = std::numeric_limits<double>::quiet_NaN();
constexpr double whole_percent = 100;
constexpr std::string_view of_ratings = "drive within its ratings";  // the check that says so

/// The bus is counted from where the brake resistor holds it: up to there nothing is used up.
double used_share(const Candidate& candidate, std::size_t rating, double share) {
  static const auto bus = rating_index("DC link above rectified mains");
  if (rating != bus || candidate.braked_share >= 1) return share;
  return std::max(0.0, (share - candidate.braked_share) / (1 - candidate.braked_share));
}

/// What does not hold of a row; "" if all does.
std::string fault_of(const PointRow& row, const RatedDrive& drive) {
  std::vector<std::string> faults;
  if (row.verdict == PointRow::Verdict::failed && row.limit != of_ratings) faults.push_back(row.limit);
  if (drive.trips > 0)
    faults.push_back(drive.trips > 1 ? fmt::format("the drive trips {:.0f} times", drive.trips)
                                     : "the drive trips");
  std::vector<std::pair<double, std::string>> over;
  for (std::size_t i = 0; i < ratings.size(); ++i) {
    const auto& [value, share] = drive.figures[i];
    if (share > 1)
      over.emplace_back(-share, fmt::format("{} {:.3g} {} ({:.0f} %)", ratings[i].name, value,
                                            ratings[i].unit, whole_percent * share));
  }
  std::stable_sort(over.begin(), over.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [share, text] : over) faults.push_back(std::move(text));
  if (drive.cycles <= 0)
    faults.emplace_back("no machine cycle has ended: what it bears for ever is not known");
  if (faults.empty() && row.verdict == PointRow::Verdict::failed)
    faults.push_back(fmt::format("{}: another drive of the line", row.limit));
  return fmt::format("{}", fmt::join(faults, "; "));
}

class CandidateJudge {
 public:
  CandidateJudge(const Candidate& candidate, const std::vector<Corner>& corners)
      : candidate_(candidate), corners_(corners) {
    sized_.reserve = no_share;
    sized_.energy = no_share;
    sized_.shares.fill(no_share);
  }

  Sized without_run() {
    sized_.reason = candidate_.unfit;
    return std::move(sized_);
  }

  /// The rows of all corners.
  Sized run(const PointRow* rows) {
    bool ran = true;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const auto& row = rows[i];
      const bool has_run =
          row.verdict == PointRow::Verdict::passed || row.verdict == PointRow::Verdict::failed;
      ran = ran && has_run;
      if (has_run) take(rated_drive(row.numbers), corners_[i].name);
      const auto fault = has_run ? fault_of(row, sized_.drives.back())
                                 : fmt::format("{}: {}", name_of(row.verdict), row.limit);
      if (!fault.empty()) add_fault(fault, corners_[i].name);
    }
    if (faults_ > 1) sized_.where += fmt::format(" and {} more", faults_ - 1);
    using Kind = Sized::Kind;
    sized_.kind = !ran                             ? Kind::ruled_out
                  : faults_ > 0                    ? Kind::falls_out
                  : sized_.reserve >= good_reserve ? Kind::fits
                                                   : Kind::close;
    return std::move(sized_);
  }

 private:
  void take(RatedDrive drive, const std::string& corner) {
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
    sized_.drives.push_back(std::move(drive));
  }

  void add_fault(const std::string& fault, const std::string& corner) {
    if (faults_++ > 0) return;
    sized_.reason = fault;
    sized_.where = corner;
  }

  const Candidate& candidate_;
  const std::vector<Corner>& corners_;
  Sized sized_;
  std::size_t faults_ = 0;
};

std::string sized_cell(double number) { return std::isnan(number) ? "" : fmt::format("{:.9g}", number); }

}  // namespace

std::string_view name_of(Sized::Kind kind) {
  constexpr std::array<std::string_view, 4> names = {"fits", "fits closely", "falls out", "ruled out"};
  return names.at(static_cast<std::size_t>(kind));
}

std::vector<Sized> size_drives(const PointQuestion& question, const std::vector<Candidate>& candidates,
                               const std::vector<Corner>& corners, PointStore& store,
                               const StudyProgress& progress) {
  std::vector<std::vector<scenario::Override>> asked;
  asked.reserve(candidates.size() * corners.size());
  for (const auto& candidate : candidates) {
    if (!candidate.unfit.empty()) continue;
    for (const auto& corner : corners) {
      asked.push_back(candidate.overrides);
      asked.back().insert(asked.back().end(), corner.overrides.begin(), corner.overrides.end());
    }
  }
  const auto rows = store.rows(question, asked, progress);
  std::vector<Sized> sized;
  sized.reserve(candidates.size());
  const auto* next = rows.data();
  for (const auto& candidate : candidates) {
    CandidateJudge judge(candidate, corners);
    if (!candidate.unfit.empty()) {
      sized.push_back(judge.without_run());
      continue;
    }
    sized.push_back(judge.run(next));
    next += corners.size();
  }
  return sized;
}

std::vector<std::size_t> ranked(const std::vector<Candidate>& candidates, const std::vector<Sized>& sized) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    const auto& one = sized[i];
    const bool good = one.kind == Sized::Kind::fits || one.kind == Sized::Kind::close;
    const double reserve = std::isnan(one.reserve) ? -std::numeric_limits<double>::infinity() : one.reserve;
    return std::tuple(one.kind, good ? candidates[i].rated_power : 0, good ? candidates[i].resistor_power : 0,
                      -reserve, std::isnan(one.energy) ? 0 : one.energy);
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

std::string size_csv(const std::vector<Candidate>& candidates, const std::vector<Sized>& sized,
                     const std::vector<std::size_t>& order) {
  std::string text =
      "rank,verdict,motor,motor values,rated power [kW],gear ratio,brake resistor,reserve [%],nearest "
      "limit,at,inertia "
      "ratio";
  for (const auto& rating : ratings)
    text += fmt::format(",{}", csv_cell(fmt::format("{} [% of its rating]", rating.name)));
  text += ",energy a cycle [J],reason,where,set\n";
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto& candidate = candidates[order[rank]];
    const auto& one = sized[order[rank]];
    text += fmt::format("{},{},{},{},{:.6g},{},{},{},{},{},{:.6g}", rank + 1, name_of(one.kind),
                        csv_cell(candidate.motor), csv_cell(candidate.values), candidate.rated_power / 1e3,
                        candidate.ratio > 0 ? number_text(candidate.ratio) : "",
                        csv_cell(candidate.resistor.text), sized_cell(one.reserve), csv_cell(one.nearest),
                        csv_cell(one.hardest), candidate.inertia_ratio);
    for (const double share : one.shares) text += "," + sized_cell(share);
    std::vector<std::string> set;
    for (const auto& [path, value] : candidate.overrides) set.push_back(fmt::format("{}={}", path, value));
    text += fmt::format(",{},{},{},{}\n", sized_cell(one.energy), csv_cell(one.reason), csv_cell(one.where),
                        csv_cell(fmt::format("{}", fmt::join(set, "; "))));
  }
  return text;
}

}  // namespace drycut::sim::studies
