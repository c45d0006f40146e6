#include "sim/cam/mc_camin/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/cam/columns.hpp"
#include "sim/cam/mc_camin/judge.hpp"
#include "sim/cam/motion_plot.hpp"

namespace drycut::sim {

namespace {

using devices::CamExtremes;
using devices::CamOrder;
using devices::CamPiece;
using devices::plcopen::Endless;
using devices::plcopen::Interpolation;

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
  const std::size_t rows = cam.table.lines();
  std::string text = fmt::format("{}: MC_CamIn, {} row{}", cam.table.file, rows, rows == 1 ? "" : "s");
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

std::string more(std::size_t all) {
  return all > most_lines ? fmt::format("  ... and {} more\n", all - most_lines) : "";
}

Columns pieces(const CamInRun& run) {
  const Scale scale(run);
  Columns columns({false, false, false, true, false, false, false, false, false});
  columns.add({"row", "master", "slave", "law", "entry", "exit", "peak v", "peak a", "peak j"});
  columns.add({"", increments_of(scale.master), increments_of(scale.slave), "", scale.unit(1), scale.unit(1),
               scale.unit(1), scale.unit(2), scale.unit(3)});
  std::size_t shown = 0;
  for (const CamPiece& piece : run.law.pieces) {
    if (piece.master < 0 || shown == most_lines) continue;
    ++shown;
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
  const auto& all = run.knots;
  Columns columns({false, false, true, false, false, false, false, true});
  columns.add({"knot", "master", "", "jump s", "jump v", "jump a", "jump j", ""});
  columns.add({"row", increments_of(scale.master), "", increments_of(scale.slave), scale.unit(1),
               scale.unit(2), scale.unit(3), ""});
  for (std::size_t i = 0; i < std::min(all.size(), most_lines); ++i) {
    const CamKnot& knot = all[i];
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

std::string totals(const CamInRun& run) {
  if (!run.runs()) return "";
  std::string text = fmt::format("master total {} {}, slave total {} {}", number_text(run.master_total()),
                                 increments_of(run.cam.master_unit), number_text(run.slave_total()),
                                 increments_of(run.cam.slave_unit));
  if (run.turns != 0)
    text +=
        fmt::format(" ({} turn{} for each of the master)", run.turns, std::abs(run.turns) == 1 ? "" : "s");
  if (run.master_speed) text += fmt::format(", {} s", plain(run.master_total() / *run.master_speed));
  return text + '\n';
}

}  // namespace

CamText cam_in_text(const CamInRun& run) {
  CamText text{heading(run), "nothing to run\n", totals(run)};
  if (!run.runs()) return text;
  Columns rows = pieces(run);
  Columns joints = knots(run);
  text.sections = rows.text() + more(run.cam.table.lines()) + '\n' + joints.text() + more(run.knots.size());
  text.tables.emplace_back("Pieces", std::move(rows));
  text.tables.emplace_back("Knots", std::move(joints));
  return text;
}

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

CamDrawing cam_in_plot(const CamInRun& run, const CamDuty& duty, const std::string& name) {
  const Scale scale(run);
  MotionPlot how;
  how.name = name;
  how.title =
      fmt::format("Cam {}, MC_CamIn {}", std::filesystem::path(run.cam.table.file).filename().string(),
                  name_of(run.cam.interpolation));
  if (scale.timed)
    how.title += fmt::format(", master at {} {}/s", plain(scale.speed / increments_per_unit), scale.master);
  how.position = scale.slave;
  how.master_position = scale.master;
  how.velocity = {scale.unit(1).empty() ? "slave/master" : scale.unit(1), 1};
  how.acceleration = {scale.unit(2), 1};
  how.jerk = {scale.unit(3), 1};
  if (scale.timed) {
    const auto limits = limits_of(run, duty);
    if (limits.velocity) how.velocity_limits.push_back({"maxvel", *limits.velocity});
    if (limits.acceleration) how.acceleration_limits.push_back({"maxacc", *limits.acceleration});
  }
  if (scale.timed && run.cam.limits.jerk) how.jerk_limits.push_back({"maxjerk", *run.cam.limits.jerk});
  const auto zones = zones_of(run);
  for (int pass = 0; pass < run.loops; ++pass)
    for (const CamZone& zone : zones)
      how.zones.push_back({(pass * run.law.master_length + zone.from) / increments_per_unit,
                           (pass * run.law.master_length + zone.to) / increments_per_unit, zone.name,
                           zone.synchronous});
  if (scale.timed) how.master_per_s = scale.speed / increments_per_unit;
  auto points = sample_cam(run, true);
  for (CamPoint& point : points) {
    point.master /= increments_per_unit;
    point.position /= increments_per_unit;
    point.velocity *= scale.of(1);
    point.acceleration *= scale.of(2);
    point.jerk *= scale.of(3);
  }
  return motion_plot(points, how);
}

}  // namespace drycut::sim
