// MC_CamIn plays cubics of one length over a turn of the master: the best cam for such a grid is played as it
// is.
#include <fmt/format.h>

#include <cmath>

#include "devices/plcopen/tab_file.hpp"
#include "sim/cams/study.hpp"
#include "sim/studies/design/fit.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double increment = 1e-7;  // of a length [m]
constexpr double turn = 3'600'000;  // [0.0001 deg]
constexpr double most_modulo = 2147483647;

/// Rows of a piece, and how many of them are synchronous.
struct CubicRows {
  int all = 0;
  int synchronous = 0;
};

/// Of 100 to 200 rows those that lengthen the synchronous way least; the moves before and behind are alike.
CubicRows rows_of(const DesignJob& job) {
  constexpr int least = 100;
  constexpr int most = 200;
  CubicRows best;
  double shortest = job.length;
  for (int all = least; all <= most; ++all) {
    const int synchronous = static_cast<int>(std::ceil(job.sync / job.length * all - 1e-9));
    const double longer = synchronous * job.length / all - job.sync;
    if ((all - synchronous) % 2 != 0 || all - synchronous < 4 || longer > shortest - 1e-9 * job.length)
      continue;
    shortest = longer;
    best = {all, synchronous};
  }
  return best;
}

devices::plcopen::CamFile empty_file(const DesignJob& job) {
  devices::plcopen::CamFile file;
  file.table.type = 5;
  file.table.id = 1;
  file.interpolation = devices::plcopen::Interpolation::polynom_3_koeff;
  file.table.interpolation = file.interpolation;
  file.master_unit = "mm";
  file.slave_unit = job.kind == DesignKind::rotary_knife ? "deg" : "mm";
  file.master_modulo = std::round(job.length * job.blades / increment);
  file.master_modulo_given = true;
  const bool saw = job.kind == DesignKind::flying_saw;
  file.slave_modulo = saw                                    ? 0
                      : job.kind == DesignKind::rotary_knife ? turn
                                                             : std::round(job.slave / increment);
  file.endless = saw ? devices::plcopen::Endless::no : devices::plcopen::Endless::positive;
  file.periodic = !saw;
  return file;
}

/// Where the table begins in the cam's cycle [m of the master], and the slave that it has 0 for [m].
struct Beginning {
  double master = 0;
  double zero = 0;
};

/// A saw's is at home, a knife's where the synchronous way begins; or whole rows before it, so that the blade
/// is at its lowest where the program has that.
Beginning beginning(const DesignedCam& cam, const DesignJob& job, double width, const DesignAxes& axes) {
  if (job.kind == DesignKind::flying_saw) return {cam.home, cam.at(cam.home).position};
  if (job.kind == DesignKind::feed || !axes.cut) return {};
  const auto piece = std::lround(job.length / width);
  const auto behind = std::lround((axes.cut->master - job.sync / 2) / width);
  const double before = static_cast<double>((behind % piece + piece) % piece) * width;
  const double cycle = job.slave * job.blades;
  const double zero = job.sync_slave() / 2 - axes.cut->slave;
  // The table begins within the first turn.
  const double turns = std::floor((cam.at(-before).position - zero) / cycle + 1e-9);
  return {-before, zero + turns * cycle};
}

/// The cam as a table; `job` has the synchronous way of its rows.
DeviceCam played(const DesignedCam& cam, const DesignJob& job, const CubicRows& rows,
                 const DesignAxes& axes) {
  DeviceCam made{.job = job, .unit = "0.1 um"};
  auto file = empty_file(job);
  const bool saw = job.kind == DesignKind::flying_saw;
  const double slave_unit = saw || job.kind == DesignKind::feed ? increment : job.slave * job.blades / turn;
  const double width = job.length / rows.all;
  const auto [begin, zero] = beginning(cam, job, width, axes);
  for (int i = 0; i < rows.all * job.blades; ++i) {
    const double master = begin + i * width;
    const auto start = cam.at(master + 1e-6 * width);  // behind a step of acceleration
    const auto middle = cam.at(master + width / 2);
    const double a0 = cam.at(master).position - zero;
    const double a1 = cam.at(master).velocity * width;
    const double a3 = start.jerk * width * width * width / 6;
    const double a2 = (middle.acceleration * width * width - 3 * a3) / 2;
    for (const double a : {a0, a1, a2, a3}) file.table.values.push_back(a / slave_unit);
  }
  const double sync_begin = saw ? job.length - begin : -begin;
  made.sync_begin = std::round(sync_begin / increment);
  made.sync_end = std::round((sync_begin + job.sync) / increment);
  if (job.speed) {
    const double units_a_metre = increment / slave_unit * 1000;  // mm or deg
    made.duty.master_speed = *job.speed * 1000;
    if (job.max_velocity) file.table.limits.velocity = *job.max_velocity * units_a_metre;
    if (job.max_acceleration) file.table.limits.acceleration = *job.max_acceleration * units_a_metre;
  }
  made.notes.push_back(fmt::format("{} cubics of {}, {} of them synchronous (POLYNOM_3_KOEFF)",
                                   rows.all * job.blades, length_text(width), rows.synchronous * job.blades));
  for (std::size_t line = 1; line <= file.table.lines(); ++line)
    file.table.places.push_back(static_cast<int>(line));
  made.table = file;
  Problems none;
  const auto study = cams::study_cam(made.table, {made.duty}, none);
  made.figures = figures_of(study.course.law, 0, job.length / increment, increment, slave_unit, job);
  // Where the carriage turns round is as exact as the cam was found: its travel begins there.
  if (job.max_travel) {
    auto& limits = made.table.as<devices::plcopen::CamFile>().table.limits;
    limits.least = std::floor(made.figures.low / increment);
    limits.most = std::ceil((made.figures.low + *job.max_travel) / increment);
  }
  return made;
}

}  // namespace

std::optional<DeviceCam> fit_mc_camin(const DesignJob& job, const DesignAxes& axes, Problems& problems) {
  whole_units("--length", job.length, increment, "0.1 um", problems);
  if (job.kind == DesignKind::feed) whole_units("--feed", job.slave, increment, "0.1 um", problems);
  for (const auto& [option, way] : {std::pair{"--length", job.length * job.blades}, {"--feed", job.slave}})
    if (way / increment > most_modulo)
      problems.push_back({"design.impossible"_code, option, 1, 1,
                          fmt::format("a cycle of {} is more than a turn", length_text(way)),
                          "give 214.7 m at most"});
  const auto rows = rows_of(job);
  if (rows.all == 0)
    problems.push_back({"design.impossible"_code, "--sync", 1, 1,
                        "too little of the piece is left for the rows of a table",
                        fmt::format("give {} at most", length_text(0.98 * job.length))});
  if (!problems.empty()) return {};

  auto stretched = job;
  stretched.sync = job.length * rows.synchronous / rows.all;
  const DesignGrid grid{(rows.all - rows.synchronous) / 2, job.kind == DesignKind::flying_saw,
                        rows.synchronous};
  std::optional<DeviceCam> made;
  fit_with_room(
      stretched,
      [&](const DesignedCam& cam) {
        made = played(cam, stretched, rows, axes);
        if (!keeps_limits(job, made->figures)) made.reset();
        return made.has_value();
      },
      grid);
  if (!made)
    problems.push_back({"design.impossible"_code, "--sync", 1, 1,
                        fmt::format("no cam of {} rows keeps the limits", rows.all),
                        "give the limits a little more room"});
  return made;
}

}  // namespace drycut::sim::studies
