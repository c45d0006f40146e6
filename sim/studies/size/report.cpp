#include "sim/studies/size/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/text.hpp"
#include "base/units.hpp"
#include "renders/report_data.hpp"
#include "sim/report/drives.hpp"
#include "sim/report/report.hpp"

namespace drycut::sim::studies {

namespace {

constexpr std::size_t most_rows_of_sizes = 200;
constexpr std::size_t most_motors_drawn = 9;
constexpr std::size_t most_corners_drawn = 6;
constexpr std::size_t most_curves = 6;
constexpr std::size_t fewest_gears = 3;  // of which a curve is drawn

std::string share_text(double share) { return std::isnan(share) ? "" : fmt::format("{:.0f}", share); }

std::string share_of(const Sized& one, std::string_view rating) {
  return share_text(one.shares.at(rating_index(rating)));
}

std::string ratio_text(const Candidate& candidate) {
  if (candidate.ratio <= 0) return "";
  return candidate.gear_kind.empty() ? fmt::format("{:.5g}", candidate.ratio)
                                     : fmt::format("{:.5g} {}", candidate.ratio, candidate.gear_kind);
}

/// `each`: every candidate that fits, else the best of each motor.
renders::ReportTable what_fits(const SizeResult& page, bool each) {
  renders::ReportTable table{
      each ? "All that fit, in this order" : "What fits: the best of each motor, in this order",
      {"", "motor", "its values", "rated power [kW]"},
      {},
      each};
  auto& headings = table.headings;
  if (!page.choices.gears.empty()) headings.emplace_back("gear");
  if (!page.choices.resistors.empty()) headings.emplace_back("brake resistor");
  headings.insert(headings.end(),
                  {"reserve [%]", "nearest limit", "at", "load / rotor inertia", "rms torque [%]",
                   "peak torque [%]", "largest speed [%]", "brake resistor [%]", "energy a cycle [J]"});
  std::set<std::string> seen;
  for (std::size_t rank = 0; rank < page.order.size() && table.rows.size() < most_rows_of_sizes; ++rank) {
    const auto& candidate = page.candidates[page.order[rank]];
    const auto& one = page.sized[page.order[rank]];
    if (!fits(one)) break;
    if (!seen.insert(candidate.motor).second && !each) continue;
    std::vector<std::string> cells = {std::to_string(rank + 1), candidate.motor, candidate.values,
                                      fmt::format("{:.3g}", candidate.rated_power / 1e3)};
    if (!page.choices.gears.empty()) cells.push_back(ratio_text(candidate));
    if (!page.choices.resistors.empty()) cells.push_back(candidate.resistor.text);
    cells.insert(cells.end(), {fmt::format("{:.1f}", one.reserve), one.nearest, one.hardest,
                               fmt::format("{:.3g}", candidate.inertia_ratio), share_of(one, "rms torque"),
                               share_of(one, "peak torque"), share_of(one, "largest speed"),
                               share_of(one, "brake resistor"), fmt::format("{:.4g}", one.energy)});
    table.rows.push_back({std::move(cells)});
  }
  return table;
}

/// "119 % of rms torque"; "" where nothing is short, "?" where nobody can say.
std::string short_words(const Sized& one) {
  const auto& distance = one.distance;
  if (one.kind == Sized::Kind::does_not_fit && distance.unknown > 0) return "?";
  return distance.short_by > 0 ? fmt::format("{:.3g} % of {}", distance.short_by, distance.rating) : "";
}

/// `each`: every candidate that does not fit, else the nearest of each motor.
renders::ReportTable what_does_not_fit(const SizeResult& page, bool each) {
  renders::ReportTable table{each ? "What does not fit and why, the nearest to fitting first"
                                  : "What comes nearest: the best of each motor",
                             {"motor", "gear", "brake resistor", "short by", "why", "at", "rms torque [%]",
                              "peak torque [%]", "largest speed [%]", "load / rotor inertia"},
                             {},
                             each};
  std::set<std::string> seen;
  std::size_t more = 0;
  for (const auto i : page.order) {
    const auto& candidate = page.candidates[i];
    const auto& one = page.sized[i];
    if (fits(one) || (!seen.insert(candidate.motor).second && !each)) continue;
    if (table.rows.size() == (each ? most_rows_of_sizes : most_motors_drawn)) {
      ++more;
      continue;
    }
    table.rows.push_back(
        {{candidate.motor, ratio_text(candidate),
          candidate.resistor.text.empty() ? "as it is" : candidate.resistor.text, short_words(one),
          one.reason, one.where, share_of(one, "rms torque"), share_of(one, "peak torque"),
          share_of(one, "largest speed"),
          candidate.inertia_ratio > 0 ? fmt::format("{:.3g}", candidate.inertia_ratio) : ""}});
  }
  if (more > 0 && each) table.title += fmt::format("; {} more are in size.csv", more);
  return table;
}

/// The first of each motor in the order, of those that are known at one corner at least.
std::vector<std::size_t> best_of_motors(const SizeResult& page) {
  std::set<std::string> seen;
  std::vector<std::size_t> best;
  for (const auto i : page.order)
    if (const auto& drives = page.sized[i].drives;
        std::any_of(drives.begin(), drives.end(), [](const auto& drive) { return drive.has_value(); }) &&
        seen.insert(page.candidates[i].motor).second)
      best.push_back(i);
  return best;
}

/// The corners in which most of a rating is used, of those that are known.
std::vector<std::size_t> hardest_corners(const Sized& one) {
  const auto used = [&](std::size_t corner) {
    double most = 0;
    for (const auto& figure : one.drives[corner]->figures) most = std::fmax(most, figure.share);
    return most;
  };
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < one.drives.size(); ++i)
    if (one.drives[i]) corners.push_back(i);
  std::stable_sort(corners.begin(), corners.end(),
                   [&](std::size_t a, std::size_t b) { return used(a) > used(b); });
  corners.resize(std::min(corners.size(), most_corners_drawn));
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Operating points of a candidate at its hardest corners, in the borders of its motor.
renders::Plot operating_points(const SizeResult& page, std::size_t rank, std::size_t which) {
  const auto& candidate = page.candidates[which];
  const auto& one = page.sized[which];
  renders::Plot plot;
  plot.name = fmt::format("motor_{}", rank + 1);
  plot.title = name_of(candidate);
  plot.x_label = "motor speed [rpm]";
  plot.width = 760;
  plot.panel_height = 430;
  renders::Panel panel;
  panel.title = fits(one)
                    ? fmt::format("{}: {:.0f} % left of {}", name_of(one.kind), one.reserve, one.nearest)
                    : "does not fit: " + one.reason.substr(0, one.reason.find_first_of(",;"));
  panel.y_label = "motor torque [N m]";
  bool both_ways = false;
  renders::Curve rms{"rms of the hardest cycle", {}, {}, renders::Curve::Style::points};
  for (const auto corner : hardest_corners(one)) {
    const auto& drive = *one.drives[corner];
    renders::Curve points{page.corners[corner].name, {}, {}, renders::Curve::Style::points};
    for (const auto& [speed, torque] : drive.outline) {
      if (std::isnan(speed)) continue;
      points.x.push_back(speed * units::rpm);
      points.y.push_back(torque);
      both_ways = both_ways || speed < -0.02 * candidate.ratings.max_speed;
    }
    if (!std::isnan(drive.rms.first)) {
      rms.x.push_back(drive.rms.first * units::rpm);
      rms.y.push_back(drive.rms.second);
    }
    panel.curves.push_back(std::move(points));
  }
  panel.curves.push_back(std::move(rms));
  panel.curves.push_back(report::peak_curve(candidate.ratings, both_ways));
  panel.curves.push_back(report::continuous_curve(candidate.ratings, both_ways));
  plot.panels.push_back(std::move(panel));
  return plot;
}

renders::ReportSection operating_section(const SizeResult& page, std::vector<renders::Plot>& plots) {
  const auto best = best_of_motors(page);
  renders::ReportSection section;
  for (std::size_t rank = 0; rank < std::min(best.size(), most_motors_drawn); ++rank)
    plots.push_back(operating_points(page, rank, best[rank]));
  section.title = "Operating points over the motors' curves";
  section.notes = {fmt::format(
      "The best gear and resistor of {} of {} motors, in the order of the table, then those that come "
      "nearest. At each speed the highest and the lowest "
      "torque of the whole run, at {} of {} corners{}; none of a corner at which the run ended early.",
      plots.size(), best.size(), std::min(page.corners.size(), most_corners_drawn), page.corners.size(),
      page.corners.size() > most_corners_drawn ? ", those that use most" : "")};
  return section;
}

/// Reserve, torque and inertia over the gear, a curve a motor.
std::optional<renders::Plot> over_gears(const SizeResult& page) {
  if (page.choices.gears.empty() || page.choices.gears.front().values.size() < fewest_gears) return {};
  renders::Plot plot;
  plot.name = "over_gears";
  plot.title =
      "Over the gear's ratio, the best motors, at the hardest corner; a gap: not known, for a run ended "
      "early";
  plot.x_label = "gear ratio";
  plot.panel_height = 260;
  plot.panels = {{"", "reserve [%]", {}, {}, std::pair(-50.0, 100.0)},
                 {"", "rms torque [% of S1]", {}, {}, std::pair(0.0, 150.0)},
                 {"", "load / rotor inertia", {}, {}, {}}};
  plot.panels[0].bands = {{"", 0, 0}};
  const auto rms = rating_index("rms torque");
  for (const auto best : best_of_motors(page)) {
    std::vector<std::size_t> same;
    for (std::size_t i = 0; i < page.candidates.size(); ++i)
      if (page.candidates[i].motor == page.candidates[best].motor &&
          page.candidates[i].resistor.text == page.candidates[best].resistor.text)
        same.push_back(i);
    const bool any =
        std::any_of(same.begin(), same.end(), [&](auto i) { return !std::isnan(page.sized[i].reserve); });
    if (same.size() < 2 || !any) continue;
    std::sort(same.begin(), same.end(),
              [&](auto a, auto b) { return page.candidates[a].ratio < page.candidates[b].ratio; });
    std::array<renders::Curve, 3> curves;
    for (auto& curve : curves) curve.label = page.candidates[best].motor;
    for (const auto i : same) {
      const auto& one = page.sized[i];
      const bool known = !std::isnan(one.reserve);
      const std::array<double, 3> values = {known ? std::max(-50.0, one.reserve) : one.reserve,
                                            known ? std::min(150.0, one.shares.at(rms)) : one.reserve,
                                            page.candidates[i].inertia_ratio};
      for (std::size_t k = 0; k < curves.size(); ++k) {
        curves.at(k).x.push_back(page.candidates[i].ratio);
        curves.at(k).y.push_back(values.at(k));
      }
    }
    for (std::size_t k = 0; k < curves.size(); ++k) plot.panels[k].curves.push_back(std::move(curves.at(k)));
    if (plot.panels[0].curves.size() == most_curves) break;
  }
  if (plot.panels[0].curves.empty()) return {};
  return plot;
}

/// What the command changes beside motor, gear and resistor, as a fact.
std::string taken_along(const SizeResult& page) {
  std::string text =
      page.choices.drive.is_servo()
          ? "inertia ratio set in the amplifier: the speed loop stays as quick as the scenario has it"
          : "nothing";
  if (page.choices.gears.empty()) return text;
  if (page.choices.gear_is_tied) return text + "; with the gear what the scenario ties to it";
  return text +
         "; with the gear the speed at 10 V or the electronic gear, and the lines of a motor encoder that "
         "the "
         "controller counts";
}

std::string in_shell(const std::string& words) {
  std::string text = "'";
  for (const char c : words) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

record::Verdict verdict_of(const SizeResult& page) {
  record::Verdict verdict;
  const auto fitting = count_fitting(page);
  verdict.title =
      fmt::format("Sizing of {} in {}", page.choices.drive.full_name(), page.question.file.stem().string());
  verdict.judge(fitting > 0);
  verdict.sentence = best_words(page);
  if (fitting > 0) {
    verdict.word = fmt::format("{} FIT", fitting);
    verdict.sentence = fmt::format("of {} at {}; {}", counted(std::ssize(page.candidates), "candidate"),
                                   counted(std::ssize(page.corners), "corner"), verdict.sentence);
  }
  verdict.counts = {{"candidates", std::ssize(page.candidates)},
                    {"corners", std::ssize(page.corners)},
                    {"fitting", static_cast<std::int64_t>(fitting)}};
  verdict.scenarios = {page.question.file.generic_string()};
  return verdict;
}

renders::Report size_page(const SizeResult& page, const record::Verdict& verdict) {
  auto report = report::page_of(verdict);
  const auto fitting = count_fitting(page);
  report.scenario = page.question.file.filename().string();
  std::vector<std::string> names;
  for (const auto& corner : page.corners) names.push_back(corner.name);
  report.facts = {
      {{"scenario", page.question.file.string()}},
      {{"drive", page.choices.drive.full_name()}},
      {{"candidates",
        fmt::format(
            "{}, {}, {}", counted(page.choices.motors.size(), "motor"),
            counted(page.choices.gears.empty() ? 1 : std::ssize(page.choices.gears.front().values), "gear"),
            counted(std::max<std::ptrdiff_t>(1, std::ssize(page.choices.resistors)), "brake resistor"))}},
      {{"corners", fmt::format("{}", fmt::join(names, " | "))}},
      {{"fits",
        "every check and every rating holds at every corner, in closed loop with the controller's program"}},
      {{"reserve",
        "least distance to a rating over all corners; of the bus voltage from where the brake resistor "
        "holds it"}},
      {{"order",
        fmt::format("a reserve of {:.0f} % or more before less; then the smallest motor by rated power, the "
                    "smallest brake resistor, the largest reserve, the least energy",
                    good_reserve)}},
      {{"short by",
        "the largest share of a rating beyond 100 %, over all corners; where a run ended early or at its "
        "limit, "
        "what a motor of that inertia without limits needs there"}},
      {{"set up with each", taken_along(page)}},
      {{"as the scenario has it",
        fmt::format("stiffness, play{} of the gear, with every candidate",
                    page.choices.has_gear_kinds() ? " and friction" : ", friction and efficiency")}},
      {{"drycut", DRYCUT_VERSION}}};
  report::add_overrides(page.question.set, report);
  report.notes = record::lines_of(size_notes(page));
  report.summary = {fitting > 0 ? what_fits(page, false) : what_does_not_fit(page, false)};
  if (fitting > 0) report.tables.push_back(what_fits(page, true));
  if (fitting < page.sized.size()) report.tables.push_back(what_does_not_fit(page, true));
  if (page.order.empty()) return report;
  const auto first = page.order.front();
  const auto& one = page.sized[first];
  if (one.kind == Sized::Kind::ruled_out) return report;
  const auto& hardest = !fits(one) && !one.distance.corner.empty() ? one.distance.corner : one.hardest;
  const auto corner = std::find_if(page.corners.begin(), page.corners.end(),
                                   [&](const auto& known) { return known.name == hardest; });
  report.texts.push_back({fits(one)
                              ? "The command that runs the first of them at its hardest corner with pictures"
                              : fmt::format("The command that shows with pictures how {}, the nearest, fails",
                                            name_of(page.candidates[first])),
                          command_for(page.question, page.candidates[first],
                                      corner == page.corners.end() ? page.corners.front() : *corner)});
  return report;
}

}  // namespace

std::string command_for(const PointQuestion& question, const Candidate& candidate, const Corner& corner) {
  auto text = "drycut run " + in_shell(question.file.string());
  for (const auto* overrides : {&question.set, &candidate.overrides, &corner.overrides})
    for (const auto& [path, value] : *overrides)
      text += " --set " + in_shell(fmt::format("{}={}", path, value));
  return text;
}

record::Verdict write_size_report(const SizeResult& page, OutputFolder& folder) {
  auto verdict = verdict_of(page);
  auto report = size_page(page, verdict);
  if (auto plot = over_gears(page)) report::add_plots({std::move(*plot)}, folder, report);
  std::vector<renders::Plot> small;
  auto section = operating_section(page, small);
  if (!small.empty()) {
    std::vector<std::string> names;
    names.reserve(small.size());
    for (const auto& plot : small) names.push_back(plot.name + ".png");
    const auto pictures = renders::draw_plots(small, folder.add(report::plots_folder, names));
    for (std::size_t i = 0; i < small.size(); ++i)
      section.plots.push_back({pictures[i], "", renders::plot_words(small[i])});
    report.sections.push_back(std::move(section));
    for (auto& plot : small) report.live.push_back(std::move(plot));
  }
  report::write_report(std::move(report), {}, folder);
  return verdict;
}

}  // namespace drycut::sim::studies
