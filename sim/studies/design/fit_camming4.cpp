// CAMMING4 plays sectors of whole Um: ramps of its 133 and 134, for the least jerk those of 233 and 234.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "devices/camming4/cam_table.hpp"
#include "sim/cams/study.hpp"
#include "sim/studies/design/fit.hpp"
#include "sim/studies/design/ramps.hpp"

namespace drycut::sim::studies {

namespace {

using devices::camming4::CamSectors;
using devices::camming4::Row;

constexpr int most_space = 999999;  // of a sector [Um]
constexpr int most_decpt = 3;

/// The job in whole Um.
struct UmJob {
  int decpt = 1;
  int length = 0;
  int slave = 0;
  int sync = 0;
  double um = 0;  ///< [m]
};

std::optional<UmJob> in_um(const DesignJob& job, const DesignAxes& axes, Problems& problems) {
  Problems why;
  for (int decpt = axes.decpt.value_or(1); decpt <= axes.decpt.value_or(most_decpt); ++decpt) {
    UmJob um{.decpt = decpt, .um = 1e-3 / std::pow(10, decpt)};
    const auto unit = fmt::format("{} mm", std::pow(10, -decpt));
    Problems here;
    const auto length = whole_units("--length", job.length, um.um, unit.c_str(), here);
    const auto slave = whole_units(job.kind == DesignKind::feed ? "--feed" : "--circumference", job.slave,
                                   um.um, unit.c_str(), here);
    for (const auto& [option, number] : {std::pair{"--length", length}, {"--circumference", slave}})
      if (number && *number > most_space)
        here.push_back({"design.impossible"_code, option, 1, 1,
                        fmt::format("{:.0f} Um are more than a sector takes", *number),
                        fmt::format("give {} at most{}", length_text(most_space * um.um),
                                    decpt > 1 ? ", or a lower --decpt" : "")});
    if (!here.empty()) {
      if (why.empty()) why = here;
      continue;
    }
    um.length = static_cast<int>(*length);
    um.slave = static_cast<int>(*slave);
    um.sync = static_cast<int>(std::ceil(job.sync / um.um - 1e-6));
    // A knife that starts on top goes half of the rest to its first cut.
    if (job.kind == DesignKind::rotary_knife && (um.slave - um.sync) % 2 != 0) ++um.sync;
    return um;
  }
  problems.insert(problems.end(), why.begin(), why.end());
  return {};
}

class SectorTable {
 public:
  SectorTable(const DesignJob& job, const UmJob& um, bool cycloidal)
      : job_(job), um_(um), cycloidal_(cycloidal) {}

  int add(int code, int qm, int qs, int codeM = 0) {
    ++rows_;
    table.sectors[static_cast<std::size_t>(rows_ - 1)] = {Row{code, qm, qs, 0, 0, codeM}, rows_};
    return rows_;
  }
  /// `from_rest`: the first one leaves standstill.
  void add(const std::vector<RampSector>& sectors, bool from_rest = false) {
    for (const auto& sector : sectors) {
      const bool back = sector.law == RampSector::Law::there_and_back;
      const bool first = from_rest && &sector == &sectors.front() && !back && sector.slave != 0;
      add((back    ? 134
           : first ? 131
                   : 133) +
              (cycloidal_ && sector.slave != 0 ? 100 : 0),
          sector.master, sector.slave);
    }
  }
  /// The zone of the cut; codeM 1000 tells it to the program.
  void add_sync() {
    const double before = master_;
    if (um_.sync > 0) add(133, um_.sync, static_cast<int>(job_.ratio()) * um_.sync, 1000);
    sync_begin = before;
  }
  /// From standstill, half-way between two cuts, to the master's speed where the zone begins.
  void add_start(double most_gradient) {
    const auto fits = [&](int code, int way) {
      const double gradient = (code == 232 ? 2.0 : 1.0) / (2.0 * way);
      return most_gradient == 0 || gradient <= most_gradient;
    };
    for (int way = (um_.slave - um_.sync) / 2; way <= most_space / 2; way += um_.slave)
      for (const int code : {232, 132}) {
        if (!fits(code, way)) continue;
        add(code, 2 * way, way);
        master_ = 2.0 * way;
        return;
      }
  }
  void close(int again) {
    add(139, um_.length, um_.slave);
    add(137, again, 0);
  }
  void pass(double master) { master_ += master; }

  CamSectors table;
  double sync_begin = 0;

 private:
  const DesignJob& job_;
  const UmJob& um_;
  bool cycloidal_;
  int rows_ = 0;
  double master_ = 0;
};

std::vector<RampSector> backwards(std::vector<RampSector> sectors) {
  std::reverse(sectors.begin(), sectors.end());
  return sectors;
}

int master_of(const std::vector<RampSector>& sectors) {
  int sum = 0;
  for (const auto& sector : sectors) sum += sector.master;
  return sum;
}

RampAims aims_of(const DesignJob& job, const UmJob& um) {
  RampAims aims;
  aims.goal = job.goal;
  aims.cycloidal = job.goal == MoveGoal::jerk;
  aims.no_reverse = job.no_reverse;
  if (job.max_velocity) aims.most_ratio = *job.max_velocity / *job.speed;
  if (job.max_acceleration) aims.most_gradient = *job.max_acceleration / (*job.speed * *job.speed) * um.um;
  if (job.max_travel) aims.most_down = std::max(1, static_cast<int>(*job.max_travel / um.um - um.sync) / 2);
  aims.friction = {job.friction().viscous * um.um, job.friction().coulomb * um.um};
  constexpr double samplings = 1.5;  // at least, for each of a sector's phases
  const double sampling = CamSectors().TCamp * 1e-3;
  aims.shortest = job.speed ? static_cast<int>(std::ceil(samplings * *job.speed * sampling / um.um)) : 1;
  aims.most_sectors = devices::camming4::cam_rows - 5;
  return aims;
}

/// measure and pulse: Um, and counts in them.
bool set(devices::camming4::GrainResolution& resolution, const PulseWay& way, int decpt, const char* option,
         Problems& problems) {
  double um = way.millimetres * std::pow(10, decpt);
  double count = way.count;
  constexpr double most = 999999;
  while (std::abs(um - std::round(um)) > 1e-9 * um && um < most && count < most) {
    um *= 10;
    count *= 10;
  }
  if (um <= most && count <= most && std::abs(um - std::round(um)) <= 1e-9 * um) {
    resolution.measure = static_cast<std::int32_t>(std::round(um));
    resolution.pulse = static_cast<std::int32_t>(std::round(count));
    return true;
  }
  problems.push_back({"design.impossible"_code, option, 1, 1,
                      "no whole numbers of Um and counts up to 999999 have this ratio",
                      "give the way of more counts, such as 600 mm/40960"});
  return false;
}

/// The part of the way behind the synchronous one after which the slave stands; nothing if it never does.
std::optional<double> standstill(const DesignedCam& cam) {
  constexpr double stands = 1e-3;
  if (cam.job.kind == DesignKind::feed) return {};
  constexpr int places = 4000;
  for (int i = 1; i <= places; ++i) {
    const double part = 0.5 * i / places;
    if (cam.at(cam.job.sync + part * cam.job.way()).velocity <= stands) return part;
  }
  return {};
}

/// `asked`: the job with the limits that the table must keep.
std::optional<SectorTable> table_of(const DesignedCam& cam, const DesignJob& asked, const UmJob& um) {
  const auto& job = cam.job;
  const auto aims = aims_of(asked, um);
  const int master = um.length - um.sync;
  const int slave = um.slave - static_cast<int>(job.ratio()) * um.sync;
  const WantedSpeed wanted = [&](double part) { return cam.at(job.sync + part * job.way()).velocity; };
  SectorTable made(job, um, aims.cycloidal);
  if (job.kind == DesignKind::rotary_knife) made.add_start(aims.most_gradient);
  const bool saw = job.kind == DesignKind::flying_saw;
  const int again = job.kind == DesignKind::rotary_knife ? 2 : 1;
  if (const auto still = standstill(cam)) {
    const auto turn = turn_round(master, slave, *still, wanted, aims);
    if (!turn) return {};
    const auto up = backwards(turn->down);
    if (saw) {
      made.add(up, true);
      made.pass(master_of(up));
    }
    made.add_sync();
    made.add(turn->down);
    made.add(turn->out);
    if (!saw) made.add(up, true);
  } else {
    const auto ramps = out_and_back(master, slave, static_cast<int>(job.ratio()), wanted, aims);
    if (!ramps) return {};
    made.add_sync();
    made.add(ramps->sectors, job.kind == DesignKind::feed);
  }
  made.close(again);
  return made;
}

/// The least jerk of S ramps over half the way back, by master lengths: of one ramp to the speed in the
/// middle, or of two with standstill between them. A ramp that changes the speed by dv over L has 2 pi
/// dv/L^2, so two of the same jerk have dv in proportion to L^2.
double least_jerk(const DesignJob& job, bool turns) {
  const double half = job.way() / 2;
  const double slave = (job.slave - job.ratio() * job.sync) / 2;
  if (!turns) return 2 * std::numbers::pi * 2 * std::abs(slave - job.ratio() * half) / std::pow(half, 3);
  // The way of the first ramp less that of the second is the slave's: l/2 - m^3/(2 l^2), with l + m the half.
  const auto second = [&](double first) { return std::cbrt(first * first * (first - 2 * slave)); };
  double least = 0;
  double most = half;
  for (int i = 0; i < 100; ++i) {
    const double middle = (least + most) / 2;
    (middle + second(middle) < half ? least : most) = middle;
  }
  return 2 * std::numbers::pi / (least * least);
}

/// What the device makes of a table.
DeviceCam played(SectorTable table, const DesignJob& job, const UmJob& um) {
  DeviceCam made{.job = job, .unit = "Um"};
  if (job.speed) made.duty.master_speed = *job.speed * 1000;
  if (job.speed && job.max_velocity) made.duty.max_velocity = *job.max_velocity * 1000;
  if (job.speed && job.max_acceleration) made.duty.max_acceleration = *job.max_acceleration / um.um;
  if (job.max_travel) table.table.travel = {0.0, std::ceil(*job.max_travel / um.um)};
  made.sync_begin = table.sync_begin;
  made.sync_end = made.sync_begin + um.sync;
  const auto rows = std::count_if(table.table.sectors.begin(), table.table.sectors.end(),
                                  [](const auto& sector) { return sector.line > 0; });
  made.notes.push_back(fmt::format("{} sectors, 1 Um = {} mm", rows, std::pow(10, -um.decpt)));
  made.table = table.table;
  Problems none;
  const auto study = cams::study_cam(made.table, {made.duty}, none);
  const double from = job.kind == DesignKind::rotary_knife ? table.sync_begin : 0;
  made.figures = figures_of(study.course.law, from, um.length, um.um, um.um, job);
  return made;
}

}  // namespace

std::optional<DeviceCam> fit_camming4(const DesignJob& job, const DesignAxes& axes, Problems& problems) {
  const auto um = in_um(job, axes, problems);
  CamSectors head;
  if (um) {
    head.settings.decpt = um->decpt;
    set(head.settings.master, axes.master, um->decpt, "--master-pulse", problems);
    set(head.settings.slave, axes.slave, um->decpt, "--slave-pulse", problems);
  }
  if (job.thickness > 0)
    problems.push_back(
        {"design.impossible"_code, "--thickness", 1, 1,
         "a synchronous sector of CAMMING4 is straight: it cannot follow the swing of the blade",
         fmt::format("leave it out: the blade comes into {} of material {:.2g} % slower than the web",
                     length_text(job.thickness), 100 * job.thickness / job.radius())});
  if (!problems.empty()) return {};
  auto stretched = job;
  stretched.sync = um->sync * um->um;
  std::optional<DeviceCam> made;
  fit_with_room(stretched, [&](const DesignedCam& cam) {
    auto table = table_of(cam, job, *um);
    if (!table) return false;
    table->table.settings = head.settings;
    made = played(std::move(*table), stretched, *um);
    const bool turns = standstill(cam).has_value();
    const bool free = !job.max_velocity && !job.max_acceleration && !job.max_travel && !job.no_reverse;
    if (job.goal == MoveGoal::jerk && free && !job.is_steady()) {
      made->least = least_jerk(stretched, turns);
      made->why =
          turns ? "its S ramps begin and end without acceleration, and one ends where the slave turns round"
                : "its S ramps have pi/2 of the jerk of the best ones";
    }
    if (!keeps_limits(job, made->figures)) made.reset();
    return made.has_value();
  });
  if (!made)
    problems.push_back({"design.impossible"_code, "--device", 1, 1, "no sectors of CAMMING4 keep the limits",
                        "give the limits a little more room, or a finer unit by --decpt"});
  return made;
}

}  // namespace drycut::sim::studies
