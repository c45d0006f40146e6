// A cam of MC_CamIn as it runs, in words and drawn: the polynomials between its points.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "base/text.hpp"

#include "sim/cams/mc_camin/judge.hpp"

namespace drycut::sim::cams {

namespace {

using devices::CamExtremes;
using devices::CamMotion;
using devices::CamOrder;
using devices::CamPiece;
using devices::plcopen::Endless;
using devices::plcopen::Interpolation;

constexpr std::array orders = {CamOrder::position, CamOrder::velocity, CamOrder::acceleration,
                               CamOrder::jerk};

std::array<double, 4> numbers_of(const CamMotion& motion) {
  return {motion.position, motion.velocity, motion.acceleration, motion.jerk};
}

std::vector<CamKnot> knots_of(const CamInRun& run) {
  const auto& pieces = run.law.pieces;
  // Positions to a hundredth of an increment, derivatives to a millionth of their peak.
  std::array<double, 4> same{};
  for (const CamOrder order : orders)
    same[static_cast<std::size_t>(order)] = order == CamOrder::position ? 0.01 : 1e-6 * run.peak(order);
  std::vector<CamKnot> knots;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    // A turn that ends inside the last row's segment has no knot there.
    if (i == 0 && pieces.front().master < 0) continue;
    auto before = numbers_of(pieces[i == 0 ? pieces.size() - 1 : i - 1].end());
    if (i == 0) before[0] -= run.law.slave_length;
    const auto after = numbers_of(pieces[i].begin());
    CamKnot knot{pieces[i].row, pieces[i].master, pieces[i].row == 1, {}, -1};
    for (std::size_t k = 0; k < after.size(); ++k) knot.jumps[k] = after[k] - before[k];
    for (std::size_t k = 0; k < after.size() && std::abs(knot.jumps[k]) <= same[k]; ++k)
      knot.smooth = static_cast<int>(k);
    knots.push_back(knot);
  }
  return knots;
}

/// What turns derivatives in increments into deg or mm: of time if the master's speed is known, else of the
/// master.
struct Scale {
  explicit Scale(const CamInRun& run)
      : timed(run.master_speed.has_value()),
        speed(run.master_speed.value_or(increments_per_unit)),
        slave(run.cam.slave_unit),
        master(run.cam.master_unit) {}
  [[nodiscard]] double of(int order) const { return std::pow(speed, order) / increments_per_unit; }
  [[nodiscard]] std::string unit(int order) const {
    if (!timed && order == 1 && slave == master) return "";
    const std::string below = timed ? "s" : master;
    return fmt::format("{}/{}{}", slave, below, order > 1 ? std::to_string(order) : "");
  }

  bool timed;
  double speed;
  std::string slave;
  std::string master;
};

std::string law_of(const CamInRun& run, const CamPiece& piece) {
  switch (run.cam.interpolation) {
    case Interpolation::step_direct:
      return "holds";
    case Interpolation::linear:
      return "line";
    case Interpolation::polynom_3:
    case Interpolation::polynom_3_koeff:
      return "cubic";
    default:
      break;
  }
  const auto& c = polynomial_of(piece).c;
  const bool line = std::all_of(c.begin() + 2, c.end(), [](double number) { return number == 0; });
  return line ? "line" : "quintic";
}

std::string turn_text(double modulo, const std::string& unit) {
  return modulo <= 0 ? "linear"
                     : fmt::format("turn {} ({} {})", number_text(modulo),
                                   number_text(modulo / increments_per_unit), unit);
}

std::string heading(const CamInRun& run) {
  const auto& cam = run.cam;
  const char* endless = cam.endless == Endless::positive   ? ", endless positive"
                        : cam.endless == Endless::negative ? ", endless negative"
                                                           : "";
  std::string text = fmt::format("{}: MC_CamIn, {}", cam.table.file, counted(cam.table.lines(), "row"));
  if (cam.interpolation != Interpolation::table_defined)
    text += fmt::format(", {}", name_of(cam.interpolation));
  text += fmt::format("{}, {}\nmaster {}, slave {}", endless, cam.periodic ? "periodic" : "one pass",
                      turn_text(cam.master_modulo, cam.master_unit) +
                          (cam.master_modulo_given ? "" : " assumed, for there is no # master_modulo"),
                      turn_text(cam.slave_modulo, cam.slave_unit));
  if (run.master_speed)
    text +=
        fmt::format("; master at {} {}/s", plain(*run.master_speed / increments_per_unit), cam.master_unit);
  return text + '\n';
}

Columns pieces(const CamInRun& run) {
  const Scale scale(run);
  Columns columns({{"row"},
                   {"master", increments_of(scale.master)},
                   {"slave", increments_of(scale.slave)},
                   {"law", "", true},
                   {"entry", scale.unit(1)},
                   {"exit", scale.unit(1)},
                   {"peak v", scale.unit(1)},
                   {"peak a", scale.unit(2)},
                   {"peak j", scale.unit(3)}});
  for (const CamPiece& piece : run.law.pieces) {
    if (piece.master < 0) continue;
    const auto peak = [&](CamOrder order) {
      const CamExtremes extremes = piece.extremes(order);
      const double most = -extremes.low > extremes.high ? extremes.low : extremes.high;
      return plain(most * scale.of(static_cast<int>(order)));
    };
    columns.add({std::to_string(piece.row), number_text(piece.master), number_text(piece.begin().position),
                 law_of(run, piece), plain(piece.begin().velocity * scale.of(1)),
                 plain(piece.end().velocity * scale.of(1)), peak(CamOrder::velocity),
                 peak(CamOrder::acceleration), peak(CamOrder::jerk)});
  }
  return columns;
}

Columns knots(const CamInRun& run) {
  const Scale scale(run);
  Columns columns({{"knot", "row"},
                   {"master", increments_of(scale.master)},
                   {"", "", true},
                   {"jump s", increments_of(scale.slave)},
                   {"jump v", scale.unit(1)},
                   {"jump a", scale.unit(2)},
                   {"jump j", scale.unit(3)},
                   {"", "", true}});
  for (const CamKnot& knot : run.knots) {
    std::vector<std::string> cells = {std::to_string(knot.row), number_text(knot.master),
                                      knot.smooth < 0 ? "jumps" : fmt::format("C{}", knot.smooth)};
    // A jump below what counts as one is rounding.
    for (int k = 0; k < 4; ++k) {
      const double jump = k <= knot.smooth ? 0 : knot.jumps[static_cast<std::size_t>(k)];
      cells.push_back(plain(jump * (k == 0 ? 1 : scale.of(k))));
    }
    cells.emplace_back(knot.closes ? "the table closes" : "");
    columns.add(std::move(cells));
  }
  return columns;
}

CamText text_of(const CamInRun& run) {
  CamText text{heading(run)};
  if (!run.runs()) return text;
  text.tables.emplace_back("Pieces", pieces(run));
  text.tables.emplace_back("Knots", knots(run));
  text.totals = totals_text(run, increments_of(run.cam.master_unit), increments_of(run.cam.slave_unit),
                            run.turns == 0 ? ""
                                           : fmt::format(" ({} turn{} for each of the master)", run.turns,
                                                         std::abs(run.turns) == 1 ? "" : "s"));
  return text;
}

/// What the pieces of one turn do; of many, equal neighbours are one stretch.
std::vector<CamZone> zones_of(const CamInRun& run) {
  constexpr std::size_t few = 24;
  const auto& pieces = run.law.pieces;
  const bool same_units = run.cam.slave_unit == run.cam.master_unit;
  std::vector<CamZone> zones;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const CamPiece& piece = pieces[i];
    const CamExtremes speed = piece.extremes(CamOrder::velocity);
    const bool steady = speed.high - speed.low <= 1e-9 * std::max(1.0, speed.high);
    const double entry = piece.begin().velocity;
    auto name = motion_name(entry, piece.end().velocity, steady);
    // Of an angle a steady ratio is all that a cam says of the web's speed.
    const bool synchronous = steady && (same_units ? is_master_speed(entry) : std::abs(entry) > 1e-9);
    if (synchronous) name = "synchronism";
    if (!synchronous && name == "synchronism") name = "constant speed";
    if (pieces.size() <= few) name = fmt::format("{} {}", piece.row, name);
    if (!zones.empty() && zones.back().name == name)
      zones.back().to = run.end_of(i);
    else
      zones.push_back({run.begin_of(i), run.end_of(i), name, synchronous});
  }
  return zones;
}

}  // namespace

std::string increments_of(const std::string& unit) { return unit == "mm" ? "0.1 um" : "0.0001 deg"; }

CamMotionWords motion_of(const CamInRun& run, const CamDuty& duty) {
  const Scale scale(run);
  CamMotionWords how;
  how.title =
      fmt::format("Cam {}, MC_CamIn {}", std::filesystem::path(run.cam.table.file).filename().string(),
                  name_of(run.cam.interpolation));
  how.position = scale.slave;
  how.master_position = scale.master;
  how.per_unit = increments_per_unit;
  how.velocity = {scale.unit(1).empty() ? "slave/master" : scale.unit(1), scale.of(1)};
  how.acceleration = {scale.unit(2), scale.of(2)};
  how.jerk = {scale.unit(3), scale.of(3)};
  if (!scale.timed) return how;
  how.title += fmt::format(", master at {} {}/s", plain(scale.speed / increments_per_unit), scale.master);
  how.master_speed = scale.speed / increments_per_unit;
  how.speed_unit = scale.master + "/s";
  const auto limits = limits_of(run, duty);
  how.velocity.limit("maxvel", limits.velocity, "velocity {is} {unit} above {limit}");
  how.acceleration.limit("maxacc", limits.acceleration, "acceleration {is} {unit} above {limit}");
  how.jerk.limit("maxjerk", limits.jerk, "jerk {is} {unit} above {limit}");
  return how;
}

CamInRun run_cam_in(const devices::plcopen::CamFile& cam, const CamDuty& duty, int loops) {
  CamInRun run;
  run.cam = cam;
  run.loops = loops;
  run.refused = refusals(cam);
  if (duty.master_speed) run.master_speed = *duty.master_speed * increments_per_unit;
  run.law.master_length = cam.master_modulo;
  if (!run.refused.empty()) return run;
  const auto curve = curve_of(cam.table, cam.interpolation, cam.master_modulo, cam.slave_modulo, cam.endless);
  run.law = curve;
  run.turns = curve.turns;
  run.holds = cam.interpolation == devices::plcopen::Interpolation::step_direct;
  run.knots = knots_of(run);
  return run;
}

CamStudy study_of(const CamFile& cam, const CamRequest& request, Problems& /*problems*/) {
  const CamInRun run = run_cam_in(cam, request.duty, request.loops);
  CamStudy study;
  study.course = run;
  if (!cam.table.places.empty()) study.file = cam.table.file;
  study.text = text_of(run);
  study.findings = judge_cam_in(run, request.duty);
  study.master_unit = increments_of(cam.master_unit);
  if (!run.runs()) return study;
  study.zones = zones_of(run);
  study.motion = motion_of(run, request.duty);
  return study;
}

IdealCam ideal_of(const CamFile& cam, MasterRange range) {
  const auto run = run_cam_in(cam, {}, 1);
  IdealCam ideal;
  ideal.master_unit = cam.master_unit;
  ideal.slave_unit = cam.slave_unit;
  ideal.shown = 1 / increments_per_unit;
  ideal.error_unit = cam.slave_unit;
  ideal.error_scale = ideal.error_step = 1 / increments_per_unit;
  ideal.speed_scale = 1 / increments_per_unit;
  repeat(ideal, run, range, zones_of(run));
  return ideal;
}

std::vector<CamKey> mc_camin_keys() {
  std::vector<CamKey> keys;
  for (const auto& key : devices::plcopen::cam_file_keys())
    keys.push_back({std::string(key.name), std::string(key.values), std::string(key.fallback),
                    std::string(key.meaning)});
  return keys;
}

std::vector<CamKey> mc_camin_columns() {
  return {{"slave", "a number", "required",
           "position of the slave [0.1 um or 0.0001 deg]; alone, the rows divide the master's turn evenly"},
          {"master", "a number", "", "position of the master, ascending, for LINE_POLY5 and POLY5_LINE"},
          {"a0, a1, a2, a3", "numbers", "", "in place of slave: coefficients of each row's polynomial"}};
}

CamFile read_mc_camin(std::string_view text, const std::string& file, Problems& problems) {
  return devices::plcopen::read_cam(text, file, problems).value_or(CamFile{});
}

std::string file_of(CamFile& cam, const std::string& file) {
  constexpr std::array endless = {"negative", "no", "positive"};
  auto& table = cam.table;
  const bool tab = std::filesystem::path(file).extension() == ".tab";
  auto text = table.file.empty() ? "" : fmt::format("## {}\n", table.file);
  if (!tab) text += fmt::format("# interpolation: {}\n", name_of(cam.interpolation));
  text += fmt::format(
      "# master_modulo: {:.0f}\n# slave_modulo: {:.0f}\n# endless: {}\n# periodic: {}\n"
      "# master_unit: {}\n# slave_unit: {}\n",
      cam.master_modulo, cam.slave_modulo,
      endless[static_cast<std::size_t>(static_cast<int>(cam.endless) + 1)], cam.periodic ? "yes" : "no",
      cam.master_unit, cam.slave_unit);
  for (const auto& [key, limit] : {std::pair{"maxvel", cam.table.limits.velocity},
                                   {"maxacc", cam.table.limits.acceleration},
                                   {"minpos", cam.table.limits.least},
                                   {"maxpos", cam.table.limits.most}})
    if (limit) text += fmt::format("# {}: {}\n", key, *limit);
  if (tab)
    text += fmt::format(
        "Tablename    = {}\nTabletype    = {}\nTable-ID     = {}\nFunctiontype = {} # {}\nLines        = {}\n"
        "Begintable\n",
        std::filesystem::path(file).stem().string(), table.type, table.id,
        static_cast<int>(cam.interpolation), name_of(cam.interpolation), table.lines());
  const int columns = table.columns();
  cam.header = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
  table.places.clear();
  text += tab ? "# " : "";
  text += columns == 4 ? "a0,a1,a2,a3\n" : columns == 2 ? "master,slave\n" : "slave\n";
  for (std::size_t line = 0; line < table.lines(); ++line) {
    table.places.push_back(cam.header + 1 + static_cast<int>(line));
    for (int column = 0; column < columns; ++column)
      fmt::format_to(std::back_inserter(text), "{}{}", table.value(line, column),
                     column + 1 == columns ? '\n'
                     : tab                 ? ' '
                                           : ',');
  }
  if (tab) text += "EndTable\n";
  table.file = file;
  return text;
}

}  // namespace drycut::sim::cams
