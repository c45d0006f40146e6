// A cam of CAMMING4 in words and drawn, and as what a run is compared with: the laws of its sectors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "base/text.hpp"

#include "sim/cams/camming4/judge.hpp"

namespace drycut::sim::cams {

namespace {

namespace camming4 = devices::camming4;

constexpr std::size_t most_sectors = 400;  // of sectors that run differently each time round

/// Without what rounding leaves of a zero.
std::string rounded(double value) { return number_text(std::abs(value) < 1e-14 ? 0 : value, 6); }

/// What a row does, in words; a cycloidal code's words are its straight one's.
std::string meaning(const camming4::Row& row) {
  const auto* code = camming4::find_code(row.codeG);
  if (code == nullptr) return "";
  const auto* straight = code->epicycloidal ? camming4::find_code(code->code - 100) : nullptr;
  if (straight != nullptr) return fmt::format("{} (cycloidal)", straight->meaning);
  std::string text(code->meaning);
  if (row.codeG == 137) text += fmt::format(": {}", row.codeQm);
  if (row.codeG == 190) text += fmt::format(": {}, {} times", row.codeQm, row.codeQs);
  if (row.codeG == 160) text += fmt::format(": {} Um", row.codeQm);
  return text;
}

class StudyReport {
 public:
  StudyReport(const CammingTable& table, const CamDuty& duty, const CamRun& run)
      : table_(table), duty_(duty), run_(run), master_(run.master_speed.value_or(0)) {}

  [[nodiscard]] CamText text() {
    auto columns = sectors();
    return {heading(),
            {{"Sectors in the order of running", std::move(columns)}},
            totals_text(run_, "Um", "Um", run_.passes > 1 ? fmt::format(" in {} passes", run_.passes) : "")};
  }

 private:
  [[nodiscard]] std::string heading() const {
    const auto& axes = table_.settings;
    const auto bit = [](const camming4::GrainResolution& axis) {
      return rounded(static_cast<double>(axis.measure) / static_cast<double>(axis.pulse));
    };
    auto text =
        fmt::format("{}: CAMMING4, {}; 1 bit x4 = {} Um of the master, {} Um of the slave\n", table_.file,
                    counted(table_.count(), "sector"), bit(axes.master), bit(axes.slave));
    if (master_ > 0)
      text += fmt::format("master at {} {} = {} Um/s, sampled every {} ms\n", rounded(*duty_.master_speed),
                          speed_unit(table_), rounded(master_), table_.TCamp);
    if (table_.settings.decpt > 0)
      text +=
          fmt::format("speeds in units of {} Um (decpt {})\n", rounded(std::pow(10, axes.decpt)), axes.decpt);
    return text;
  }

  /// The sectors in the order of running; one that runs again in the same way is only counted.
  Columns sectors() {
    std::size_t passage = 0;
    for (std::size_t i = 0; i <= run_.shown; ++i) {
      for (; passage < run_.passages.size() && run_.passages[passage].visits <= i; ++passage)
        for (const int row : run_.passages[passage].rows) count(row, {"", "", "", "", "", ""}, {"", "", ""});
      if (i < run_.shown) add(run_.visits[i]);
    }
    const auto told = lines_.begin() + static_cast<std::ptrdiff_t>(std::min(lines_.size(), most_sectors));
    const bool repeats =
        std::any_of(lines_.begin(), told, [&](const auto& cells) { return times_.at(cells) > 1; });
    std::vector<Columns::Heading> headings = {{"row"},         {"code", "", true}, {"master", "Um"},
                                              {"slave", "Um"}, {"entry"},          {"exit"},
                                              {"peak v"},      {"peak a", "1/Um"}};
    if (master_ > 0)
      headings.insert(headings.end(), {{"time", "s"}, {"peak v", speed_unit(table_)}, {"peak a", "Um/s2"}});
    if (repeats) headings.push_back({"times"});
    headings.push_back({"what it does", "", true});
    Columns columns(std::move(headings));
    columns.left_out(" that run differently each time");
    for (auto& cells : lines_) {
      if (repeats) cells.insert(cells.end() - 1, std::to_string(times_.at(cells)));
      columns.add(std::move(cells), most_sectors);
    }
    return columns;
  }

  void add(const CamVisit& visit) {
    const double peak = peak_speed(visit);
    const double gradient = peak_gradient(visit);
    std::vector<std::string> timed;
    if (master_ > 0)
      timed = {rounded(visit.master_length / master_), rounded(peak * *duty_.master_speed),
               rounded(gradient * master_ * master_)};
    count(visit.row,
          {rounded(visit.master_length), rounded(visit.slave_length), rounded(visit.entry_speed()),
           rounded(visit.exit_speed()), rounded(peak), rounded(gradient)},
          timed);
  }

  /// A line of the table, or how often the cam ran it just so.
  void count(int number, const std::vector<std::string>& figures, const std::vector<std::string>& timed) {
    const auto& row = table_.sector(number).row;
    std::vector<std::string> cells = {std::to_string(number), code_text(row.codeG)};
    cells.insert(cells.end(), figures.begin(), figures.end());
    if (master_ > 0) cells.insert(cells.end(), timed.begin(), timed.end());
    cells.push_back(meaning(row));
    if (++times_[cells] == 1) lines_.push_back(std::move(cells));
  }

  const CammingTable& table_;
  const CamDuty& duty_;
  const CamRun& run_;
  double master_;  ///< [Um/s], 0 = not given
  std::vector<std::vector<std::string>> lines_;
  std::map<std::vector<std::string>, int> times_;
};

std::string zone_name(const CammingTable& table, const CamVisit& visit, bool steady) {
  using Kind = devices::camming4::Sector::Kind;
  const auto* code = devices::camming4::find_code(table.sector(visit.row).row.codeG);
  const auto kind = visit.sector.kind;
  const auto name = visit.waiting           ? "wait"
                    : kind == Kind::gearing ? "gearing"
                    : kind == Kind::arc_x || kind == Kind::arc_y
                        ? "arc"
                        : motion_name(visit.entry_speed(), visit.exit_speed(), steady);
  return fmt::format("{} {} {}", visit.row, code->mnemonic, name);
}

/// The sectors as they ran, with row, code and what they do.
std::vector<CamZone> zones_of(const CammingTable& table, const CamRun& run) {
  std::vector<CamZone> zones;
  for (std::size_t i = 0; i < run.shown; ++i) {
    const auto& visit = run.visits[i];
    if (visit.master_length <= 0) continue;
    const bool steady = !visit.waiting && peak_gradient(visit) == 0;
    zones.push_back({visit.master_start, visit.master_end(), zone_name(table, visit, steady),
                     steady && is_master_speed(visit.entry_speed())});
  }
  return zones;
}

/// So many passes that the cam reaches `master`.
CamRun run_to(const CammingTable& table, double master) {
  auto run = run_cam(table, {}, 1);
  if (run.end != CamRun::End::came_round || run.master_total() >= master) return run;
  // The pass after the first one is judged only, but it is there: all others are as long.
  double again = 0;
  for (std::size_t i = run.shown; i < run.visits.size(); ++i) again += run.visits[i].master_length;
  if (again <= 0) return run;
  const auto visits = static_cast<double>(run.visits.size() - run.shown);
  const double most = CamRun::most_visits / std::max(visits, 1.0) - 2;
  const double wanted = std::ceil((master - run.master_total()) / again) + 1;
  return run_cam(table, {}, static_cast<int>(std::clamp(wanted, 1.0, std::max(most, 1.0))));
}

/// How much of the run the table alone says.
struct Known {
  std::size_t visits = 0;
  std::string silence;
};
Known known_of(const CamRun& run) {
  for (std::size_t i = 0; i < run.shown; ++i) {
    const CamVisit& visit = run.visits[i];
    if (visit.waiting)
      return {i, fmt::format("sector {} waits for a count of the master that the program sets", visit.row)};
    const bool released = visit.sector.kind == devices::camming4::Sector::Kind::gearing;
    if (released) return {i + 1, fmt::format("sector {} is a gearing, which the program ends", visit.row)};
  }
  return {run.shown, ""};
}

}  // namespace

CamMotionWords motion_of(const CammingTable& table, const CamDuty& duty, const CamRun& run) {
  const bool timed = run.master_speed.has_value();
  const double master = run.master_speed.value_or(1);
  const auto speed = timed ? speed_unit(table) : "Um/Um";
  CamMotionWords how;
  how.title = "Cam " + std::filesystem::path(table.file).filename().string();
  if (timed) how.title += fmt::format(", master at {} {}", number_text(*duty.master_speed, 6), speed);
  how.position = "Um";
  how.velocity = {speed, timed ? *duty.master_speed : 1};
  how.acceleration = {timed ? "Um/s²" : "Um/Um²", master * master};
  how.jerk = {timed ? "Um/s³" : "Um/Um³", master * master * master};
  if (!timed) return how;
  how.master_speed = *duty.master_speed;
  how.speed_unit = speed;
  how.velocity.limit("max velocity", duty.max_velocity, "velocity {is} {unit} above {limit}",
                     "lower its ratio {is} to {most}, or ");
  if (table.maxvel > 0)
    how.velocity.limit("maxvel", table.maxvel,
                       "velocity {is} {unit} above maxvel {limit}: the output saturates (warning 3 or 4)");
  how.acceleration.limit("max acceleration", duty.max_acceleration, "acceleration {is} Um/s2 above {limit}");
  const auto ramp = [&](const char* name, std::int32_t hundredths) {
    if (table.maxvel > 0 && hundredths > 0)
      how.acceleration.limit(name, table.maxvel * um_per_second(table) * 100 / hundredths);
  };
  const bool same = table.tdecmax == table.taccmax;
  ramp(same ? "taccmax, tdecmax" : "taccmax", table.taccmax);
  if (!same) ramp("tdecmax", table.tdecmax);
  return how;
}

CamStudy study_of(const CammingTable& table, const CamRequest& request, Problems& /*problems*/) {
  const auto run = run_cam(table, request.duty, request.loops);
  CamStudy study;
  study.course = run;
  study.zones = zones_of(table, run);
  study.motion = motion_of(table, request.duty, run);
  study.text = StudyReport(table, request.duty, run).text();
  study.findings = judge(table, request.duty, run);
  study.master_unit = "Um";
  return study;
}

IdealCam ideal_of(const CammingTable& table, MasterRange range) {
  const auto run = run_to(table, range.last);
  const auto known = known_of(run);
  const auto& slave = table.settings.slave;
  IdealCam ideal;
  ideal.master_unit = ideal.slave_unit = "Um";
  ideal.error_unit = "bits x4";
  ideal.error_scale = static_cast<double>(slave.pulse) / static_cast<double>(slave.measure);
  ideal.speed_scale = 1 / um_per_second(table);
  ideal.silence = known.silence;
  if (known.visits == 0) return ideal;
  for (std::size_t i = 0; i < known.visits; ++i) {
    const CamVisit& visit = run.visits[i];
    if (i > 0 && visit.pass == run.visits[i - 1].pass) continue;
    ideal.cycles.push_back(visit.master_start);
    ideal.origins.push_back(visit.slave_start);
  }
  const CamVisit& last = run.visits[known.visits - 1];
  ideal.cycles.push_back(last.master_end());
  ideal.origins.push_back(last.slave_start + last.slave_length);
  for (auto& zone : zones_of(table, run))
    if (zone.from < last.master_end()) ideal.zones.push_back(std::move(zone));
  const double first = run.visits[0].master_start;
  ideal.slave = [law = law_of(run.visits, known.visits), first](double master) {
    const bool inside = master >= first && master <= law.master_length;
    return inside ? at(law, master).position : std::numeric_limits<double>::quiet_NaN();
  };
  return ideal;
}

}  // namespace drycut::sim::cams
