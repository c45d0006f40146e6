// A cam of LX3VP as it runs, in words and drawn: ECAMTBX's exact laws, or the lines between given rows.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/text.hpp"
#include "devices/lx3vp/cam_law.hpp"
#include "sim/cams/lx3vp/judge.hpp"

namespace drycut::sim::cams {

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
  auto text = fmt::format("{}: LX3VP, {}", table.file, counted(table.rows.size(), "row"));
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

Columns pieces(const EcamTable& table, const CamCourse& run) {
  std::vector<Columns::Heading> headings = {
      {"piece"}, {"master", master_unit(table)}, {"slave", "pulses"}, {"entry"},
      {"exit"},  {"peak a", "1/pulse"}};
  if (run.master_speed) headings.insert(headings.end(), {{"time", "s"}, {"peak v", "Hz"}});
  headings.push_back({"what it does", "", true});
  Columns columns(std::move(headings));
  for (const auto& piece : run.law.pieces) {
    const auto& [r0, r1, shape] = ratio_of(piece);
    std::vector<std::string> cells = {std::to_string(piece.row),
                                      plain(piece.length),
                                      plain(piece.length * (r0 + r1) / 2),
                                      plain(r0),
                                      plain(r1),
                                      plain(piece.peak(CamOrder::acceleration))};
    if (run.master_speed) {
      cells.push_back(plain(piece.length / *run.master_speed));
      cells.push_back(plain(piece.peak(CamOrder::velocity) * *run.master_speed));
    }
    cells.push_back(what_it_does(table, piece));
    columns.add(std::move(cells));
  }
  return columns;
}

CamText text_of(const EcamTable& table, const CamCourse& run) {
  const auto more = run.loops > 1 ? fmt::format(" in {} cycles", run.loops) : "";
  CamText text{
      heading(table, run), {}, totals_text(run, table.time_axis == 0 ? "pulses" : "counts", "pulses", more)};
  if (run.runs()) text.tables.emplace_back("Pieces", pieces(table, run));
  return text;
}

/// The ratios of the straight pieces that the device plays.
renders::Curve played(const EcamTable& table, const CamCourse& run, double scale) {
  renders::Curve curve;
  curve.label = "as played";
  for (int pass = 0; pass < run.loops; ++pass) {
    for (const auto& piece : straight_law(table.rows).pieces) {
      for (const double end : {piece.master, piece.master + piece.length}) {
        curve.x.push_back(pass * run.law.master_length + table.rows.front().master + end);
        curve.y.push_back(ratio_of(piece).r0 * scale);
      }
    }
  }
  return curve;
}

/// What the pieces of one cycle do, from its first master position on. Of many given rows only what is long
/// at one ratio.
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

}  // namespace

CamMotionWords motion_of(const EcamTable& table, const CamDuty& duty, const CamCourse& run) {
  const bool timed = run.master_speed.has_value();
  const double speed = run.master_speed.value_or(1);
  CamMotionWords how;
  how.title = "Cam " + std::filesystem::path(table.file).filename().string();
  if (table.is_made()) how.title += ", ECAMTBX " + type_text(table);
  if (timed && table.time_axis == 0) how.title += fmt::format(", master at {} pulses/s", plain(speed));
  how.position = "pulses";
  if (table.time_axis > 0) how.master_position = master_unit(table);
  how.velocity = {timed ? "Hz" : "slave/master", speed};
  how.acceleration = {timed ? "pulses/s²" : "1/pulse", speed * speed};
  how.jerk = {timed ? "pulses/s³" : "1/pulse²", speed * speed * speed};
  if (timed) {
    how.master_speed = speed;
    how.speed_unit = "pulses/s";
    how.velocity.limit(
        "words 6-7", table.max_frequency,
        "output at {is} Hz above {limit} Hz (words 6 and 7): the slave lags and catches up later");
    how.velocity.limit("max velocity", duty.max_velocity, "velocity {is} pulses/s above {limit}");
    how.acceleration.limit("max acceleration", duty.max_acceleration,
                           "acceleration {is} pulses/s2 above {limit}");
  } else {
    how.velocity.limit(table.is_made() ? "P5" : "max_ratio", table.max_ratio);
  }
  how.straight = !table.is_made();
  if (table.is_made()) how.played = played(table, run, speed);
  return how;
}

CamCourse run_ecam(const EcamTable& table, const CamDuty& duty, int loops) {
  constexpr double ticks_per_second = 10000;
  CamCourse run;
  run.loops = loops;
  run.master_speed = duty.master_speed;
  if (table.time_axis > 0) run.master_speed = ticks_per_second / table.time_axis;
  if (table.is_made()) {
    run.law = table.made.profile;
  } else if (!table.rows.empty()) {
    run.law = straight_law(table.rows);
    run.first_master = table.rows.front().master;
    run.first_slave = table.rows.front().slave;
  }
  return run;
}

CamStudy study_of(const EcamTable& table, const CamRequest& request, Problems& problems) {
  if (table.time_axis > 0 && request.duty.master_speed)
    problems.push_back({"option.does-not-apply"_code, "--master-speed", 1, 1,
                        "the master is time and has its own speed",
                        "leave it out, or give another # time_axis"});
  const auto run = run_ecam(table, request.duty, request.loops);
  CamStudy study;
  study.course = run;
  study.zones = zones_of(table, run);
  if (run.runs()) study.motion = motion_of(table, request.duty, run);
  study.text = text_of(table, run);
  study.findings = judge_ecam(table, request.duty, run);
  study.master_unit = "pulses";
  study.rows_are_given = !table.is_made();
  if (table.is_made() && table.made.ok()) study.table = ecam_rows_csv(table);
  return study;
}

IdealCam ideal_of(const EcamTable& table, MasterRange range) {
  auto whole = table;  // what a controller holds may lack what follows from the rest
  whole.complete();
  const auto run = run_ecam(whole, {}, 1);
  IdealCam ideal;
  ideal.master_unit = table.time_axis > 0 ? "counts" : "pulses";
  ideal.slave_unit = ideal.error_unit = "pulses";
  repeat(ideal, run, range, zones_of(whole, run));
  return ideal;
}

}  // namespace drycut::sim::cams
