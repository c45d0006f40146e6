#include "sim/cam/lx3vp/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim/cam/columns.hpp"
#include "sim/cam/motion_plot.hpp"

namespace drycut::sim {

namespace {

using devices::CamOrder;
using devices::CamPiece;
using devices::Transition;
using devices::lx3vp::EcamType;

std::string type_text(const EcamTable& table) {
  constexpr const char* laws[] = {"uniform", "uniform acceleration", "B type"};
  constexpr const char* curves[] = {"leftCAM", "midCAMall", "midCAMbegin", "midCAMend", "", "rightCAM"};
  const auto law = table.saw.acceleration < std::size(laws) ? std::string(laws[table.saw.acceleration])
                                                            : fmt::format("P6L {}", table.saw.acceleration);
  const auto curve = table.saw.curve & ~devices::lx3vp::return_square;
  switch (*table.type) {
    case EcamType::s_curve_0:
      return "K0 (S-curve, cosine)";
    case EcamType::s_curve_1:
      return "K1 (S-curve, parabolas)";
    case EcamType::fly_saw:
      return fmt::format("K101 (fly saw, {})", law);
    default:
      return fmt::format("K100 (rotary saw, {}, {})",
                         static_cast<std::size_t>(curve) < std::size(curves) ? curves[curve] : "", law);
  }
}

std::string law_text(Transition law) {
  switch (law) {
    case Transition::constant:
      return "steady";
    case Transition::uniform_acceleration:
      return "ramp, uniform acceleration";
    case Transition::b_type:
      return "ramp, B type";
    case Transition::cosine:
      return "ramp, cosine";
    case Transition::parabolas:
      return "ramp, parabolas";
  }
  return "";
}

std::string what_it_does(const EcamTable& table, const CamPiece& piece) {
  if (ratio_of(piece).is_curved()) return law_text(ratio_of(piece).shape);
  if (table.made.profile.is_synchronous(piece.master + piece.length / 2)) return "synchronous";
  return ratio_of(piece).r0 == 0 ? "stands still" : law_text(ratio_of(piece).shape);
}

/// What the master counts in.
std::string master_unit(const EcamTable& table) {
  return table.time_axis == 0 ? "pulses" : fmt::format("{} us", plain(100.0 * table.time_axis));
}

std::string heading(const EcamTable& table, const CamCourse& run) {
  auto text =
      fmt::format("{}: LX3VP, {} row{}", table.file, table.rows.size(), table.rows.size() == 1 ? "" : "s");
  if (table.is_made()) text += fmt::format(" made by ECAMTBX {}", type_text(table));
  text += fmt::format(", {}\n", table.cyclic ? "cyclic" : "not cyclic");
  if (table.time_axis > 0)
    text +=
        fmt::format("master is the time axis K{}: {} counts/s", table.time_axis, plain(*run.master_speed));
  else if (run.master_speed)
    text += fmt::format("master at {} pulses/s", plain(*run.master_speed));
  if (run.master_speed) text += fmt::format(", output at {} Hz at most\n", table.max_frequency);
  return text;
}

Columns sections(const EcamTable& table, const CamCourse& run) {
  const bool timed = run.master_speed.has_value();
  std::vector<std::string> names = {"piece", "master", "slave", "entry", "exit", "peak a"};
  std::vector<std::string> units = {"", master_unit(table), "pulses", "", "", "1/pulse"};
  std::vector<bool> words(names.size(), false);
  if (timed) {
    names.insert(names.end(), {"time", "peak v"});
    units.insert(units.end(), {"s", "Hz"});
    words.insert(words.end(), 2, false);
  }
  names.emplace_back("what it does");
  words.push_back(true);
  Columns columns(words);
  columns.add(names);
  columns.add(units);
  const auto& pieces = run.law.pieces;
  const auto shown = std::min(pieces.size(), most_lines);
  for (std::size_t i = 0; i < shown; ++i) {
    const auto& piece = pieces[i];
    std::vector<std::string> cells = {std::to_string(i + 1),
                                      plain(piece.length),
                                      plain(piece.length * (ratio_of(piece).r0 + ratio_of(piece).r1) / 2),
                                      plain(ratio_of(piece).r0),
                                      plain(ratio_of(piece).r1),
                                      plain(piece.peak(CamOrder::acceleration))};
    if (timed) {
      cells.push_back(plain(piece.length / *run.master_speed));
      cells.push_back(plain(piece.peak(CamOrder::velocity) * *run.master_speed));
    }
    cells.push_back(what_it_does(table, piece));
    columns.add(std::move(cells));
  }
  return columns;
}

std::string totals(const EcamTable& table, const CamCourse& run) {
  auto text = fmt::format("master total {} {}, slave total {} pulses", number_text(run.master_total()),
                          table.time_axis == 0 ? "pulses" : "counts", number_text(run.slave_total()));
  if (run.loops > 1) text += fmt::format(" in {} cycles", run.loops);
  if (run.master_speed) text += fmt::format(", {} s", plain(run.master_total() / *run.master_speed));
  return text + '\n';
}

/// The ratios of the straight pieces that the device plays.
renders::Curve played(const EcamTable& table, const CamCourse& run, double scale) {
  renders::Curve curve;
  curve.label = "as played";
  for (int pass = 0; pass < run.loops; ++pass) {
    for (std::size_t i = 1; i < table.rows.size(); ++i) {
      const auto& from = table.rows[i - 1];
      const auto& to = table.rows[i];
      const double ratio =
          (static_cast<double>(to.slave) - from.slave) / (static_cast<double>(to.master) - from.master);
      for (const auto end : {from.master, to.master}) {
        curve.x.push_back(pass * run.law.master_length + end);
        curve.y.push_back(ratio * scale);
      }
    }
  }
  return curve;
}

}  // namespace

CamText ecam_text(const EcamTable& table, const CamCourse& run) {
  CamText text{heading(table, run), "nothing to run\n", totals(table, run)};
  const auto pieces = run.law.pieces.size();
  if (pieces == 0) return text;
  auto columns = sections(table, run);
  text.sections = columns.text();
  if (pieces > most_lines) text.sections += fmt::format("  ... and {} more\n", pieces - most_lines);
  text.tables.emplace_back("Pieces", std::move(columns));
  return text;
}

std::vector<CamZone> zones_of(const EcamTable& table, const CamCourse& run) {
  constexpr std::size_t few = 24;
  constexpr double long_share = 0.05;  // of a cycle
  constexpr double same = 1e-9;
  std::vector<CamZone> zones;
  const auto& law = run.law;
  for (std::size_t i = 0; i < law.pieces.size();) {
    const auto& first = law.pieces[i];
    // Rows at one ratio are one stretch.
    std::size_t end = i + 1;
    const auto goes_on = [&](const CamPiece& next) {
      return !ratio_of(first).is_curved() && !ratio_of(next).is_curved() &&
             std::abs(ratio_of(next).r0 - ratio_of(first).r0) <= same;
    };
    while (!table.is_made() && end < law.pieces.size() && goes_on(law.pieces[end])) ++end;
    const auto& last = law.pieces[end - 1];
    const double from = run.first_master + first.master;
    const double to = run.first_master + last.master + last.length;
    const double middle = (from + to) / 2 - run.first_master;
    const bool synchronous = table.made.profile.is_synchronous(middle);
    // A ratio of pulses says nothing of the web's speed.
    auto name = synchronous
                    ? "synchronism"
                    : motion_name(ratio_of(first).r0, ratio_of(last).r1, !ratio_of(first).is_curved());
    if (name == "synchronism" && !synchronous) name = "constant speed";
    if (law.pieces.size() <= few || to - from >= long_share * law.master_length)
      zones.push_back({from, to, fmt::format("{} {}", i + 1, name), synchronous});
    i = end;
  }
  return zones;
}

CamDrawing ecam_plot(const EcamTable& table, const CamDuty& duty, const CamCourse& run,
                     const std::string& name) {
  if (!run.runs()) return {};
  const bool timed = run.master_speed.has_value();
  const double speed = run.master_speed.value_or(1);
  MotionPlot how;
  how.name = name;
  how.title = "Cam " + std::filesystem::path(table.file).filename().string();
  if (table.is_made()) how.title += ", ECAMTBX " + type_text(table);
  if (timed && table.time_axis == 0) how.title += fmt::format(", master at {} pulses/s", plain(speed));
  how.position = "pulses";
  if (table.time_axis > 0) how.master_position = master_unit(table);
  how.velocity = {timed ? "Hz" : "slave/master", speed};
  how.acceleration = {timed ? "pulses/s²" : "1/pulse", speed * speed};
  how.jerk = {timed ? "pulses/s³" : "1/pulse²", speed * speed * speed};
  if (timed) how.velocity_limits.push_back({"words 6-7", static_cast<double>(table.max_frequency)});
  if (timed && duty.max_velocity) how.velocity_limits.push_back({"max velocity", *duty.max_velocity});
  if (timed && duty.max_acceleration)
    how.acceleration_limits.push_back({"max acceleration", *duty.max_acceleration});
  if (!timed && table.max_ratio)
    how.velocity_limits.push_back({table.is_made() ? "P5" : "max_ratio", *table.max_ratio});
  const auto zones = zones_of(table, run);
  for (int pass = 0; pass < run.loops; ++pass)
    for (const CamZone& zone : zones)
      how.zones.push_back({pass * run.law.master_length + zone.from, pass * run.law.master_length + zone.to,
                           zone.name, zone.synchronous});
  how.master_per_s = run.master_speed;
  auto drawing = motion_plot(sample_cam(run, true), how);
  auto& plot = drawing.plot;
  if (!table.is_made()) {
    // Straight pieces have no acceleration between their ends, and no end to it at them.
    plot.panels.erase(plot.panels.begin() + 2, plot.panels.end());
    drawing.peaks.resize(1);
  } else {
    plot.panels[1].curves.front().label = "law";
    // Behind the law, which it follows closely.
    plot.panels[1].curves.insert(plot.panels[1].curves.begin(), played(table, run, speed));
  }
  return drawing;
}

}  // namespace drycut::sim
