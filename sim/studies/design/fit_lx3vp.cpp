// The LX3VP plays straight pieces between rows of whole pulses: where the rows stand decides what is rounded
// off.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "devices/lx3vp/ecam_table.hpp"
#include "devices/lx3vp/registers.hpp"
#include "sim/studies/design/fit.hpp"

namespace drycut::sim::studies {

namespace {

using devices::lx3vp::CamTableRow;
using EcamRows = std::vector<CamTableRow>;

/// The job in whole pulses.
struct PulseJob {
  int length = 0;
  int slave = 0;
  int sync = 0;            ///< of the master
  int sync_slave = 0;      ///< of the slave on it
  double master_unit = 0;  ///< [m]
  double slave_unit = 0;
};

/// The synchronous way, a little longer where the slave has whole pulses then.
void take_sync(const DesignJob& job, PulseJob& pulses) {
  constexpr int most_more = 64;
  const int least = static_cast<int>(std::ceil(job.sync / pulses.master_unit - 1e-6));
  double best = 1;
  auto tried = job;
  for (int sync = least; sync <= std::min(least + most_more, pulses.length - 4); ++sync) {
    tried.sync = sync * pulses.master_unit;
    const double slave = tried.sync_slave() / pulses.slave_unit;
    const double rest = std::abs(slave - std::round(slave));
    if (rest >= best - 1e-9) continue;
    best = rest;
    pulses.sync = sync;
    pulses.sync_slave = static_cast<int>(std::lround(slave));
  }
}

std::optional<PulseJob> in_pulses(const DesignJob& job, const DesignAxes& axes, Problems& problems) {
  PulseJob pulses{.master_unit = axes.master.metres(), .slave_unit = axes.slave.metres()};
  const auto master = whole_units("--length", job.length, pulses.master_unit, "master pulses", problems);
  const auto slave = whole_units(job.kind == DesignKind::feed ? "--feed" : "--circumference", job.slave,
                                 pulses.slave_unit, "slave pulses", problems);
  constexpr double least = 1000;
  constexpr double most = 1e9;
  for (const auto& number : {master, slave})
    if (number && *number > most)
      problems.push_back({"design.impossible"_code, "--length", 1, 1,
                          fmt::format("{:.0f} pulses are more than registers hold", *number),
                          "give longer ways a pulse: --master-pulse, --slave-pulse"});
  if (master && *master < least)
    problems.push_back({"design.impossible"_code, "--master-pulse", 1, 1,
                        fmt::format("a piece of {:.0f} pulses is too coarse", *master),
                        fmt::format("give {} at most", length_text(job.length / least))});
  if (!problems.empty()) return {};
  pulses.length = static_cast<int>(*master);
  pulses.slave = static_cast<int>(*slave);
  take_sync(job, pulses);
  return pulses;
}

/// EcamRows along a cam whose table begins at its home.
class RowMaker {
 public:
  RowMaker(const DesignedCam& cam, const PulseJob& pulses) : cam_(cam), pulses_(pulses) {
    begin_ = static_cast<int>(std::lround((cam.job.length - cam.home) / pulses.master_unit));
    if (cam.job.kind == DesignKind::feed) begin_ = 0;
    if (cam.job.kind == DesignKind::rotary_knife) begin_ = (pulses.length - pulses.sync) / 2;
    origin_ = cam.at(-begin_ * pulses.master_unit).position;
  }

  /// So many pieces between the synchronous ways.
  [[nodiscard]] EcamRows rows(int pieces) const {
    const double spacing = static_cast<double>(pulses_.length - pulses_.sync) / pieces;
    const auto slave = static_cast<int>(std::lround(slave_at(begin_)));
    EcamRows rows = {{0, 0}};
    fill(rows, begin_, spacing);
    if (begin_ > 0) rows.push_back({begin_, slave});
    if (cam_.job.thickness > 0) fill(rows, begin_ + pulses_.sync, spacing);
    if (pulses_.sync > 0) rows.push_back({begin_ + pulses_.sync, slave + pulses_.sync_slave});
    fill(rows, pulses_.length, spacing);
    rows.push_back({pulses_.length, pulses_.slave});
    return rows;
  }
  [[nodiscard]] int begin() const { return begin_; }

  /// Of straight pieces, from the law [pulses].
  [[nodiscard]] double deviation(const EcamRows& rows) const {
    constexpr int points = 16;
    double most = 0;
    for (std::size_t i = 1; i < rows.size(); ++i)
      for (int n = 0; n < points; ++n) {
        const double part = static_cast<double>(n) / points;
        const double master = rows[i - 1].master + part * (rows[i].master - rows[i - 1].master);
        const double slave = rows[i - 1].slave + part * (rows[i].slave - rows[i - 1].slave);
        most = std::max(most, std::abs(slave - slave_at(master)));
      }
    return most;
  }

 private:
  [[nodiscard]] double slave_at(double master) const {
    const double along = (master - begin_) * pulses_.master_unit;
    return (cam_.at(along).position - origin_) / pulses_.slave_unit;
  }
  void fill(EcamRows& rows, int to, double spacing) const {
    const int from = rows.back().master;
    const int pieces = static_cast<int>(std::lround((to - from) / spacing));
    for (int i = 1; i < pieces; ++i) {
      const int wanted = from + static_cast<int>((static_cast<double>(to) - from) * i / pieces);
      const int master = nearly_whole(wanted, static_cast<int>(spacing / 3));
      if (master <= rows.back().master || master >= to) continue;
      rows.push_back({master, static_cast<int>(std::lround(slave_at(master)))});
    }
  }
  /// A master position near the wanted one whose slave is nearly a whole pulse.
  [[nodiscard]] int nearly_whole(int wanted, int away) const {
    constexpr double much_better = 1e-2;
    int best = wanted;
    double least = 1;
    for (int k = 0; k <= away; ++k)
      for (const int master : {wanted - k, wanted + k}) {
        const double slave = slave_at(master);
        const double rest = std::abs(slave - std::round(slave));
        if (rest >= least - much_better) continue;
        best = master;
        least = rest;
      }
    return best;
  }

  const DesignedCam& cam_;
  const PulseJob& pulses_;
  int begin_ = 0;
  double origin_ = 0;
};

/// Straight pieces have no acceleration: it is taken from the middle of one to the middle of the next. The
/// synchronous one has its ratio up to its ends.
CamFigures figures_of(const EcamRows& rows, const PulseJob& pulses, int sync_begin, const DesignJob& job) {
  CamFigures figures;
  const auto friction = job.friction();
  const auto count = rows.size() - 1;
  const auto length = [&](std::size_t i) {
    return (rows[i % count + 1].master - rows[i % count].master) * pulses.master_unit;
  };
  const auto half = [&](std::size_t i) {
    const bool synchronous = pulses.sync > 0 && job.thickness == 0 && rows[i % count].master == sync_begin;
    return synchronous ? 0 : length(i) / 2;
  };
  const auto ratio = [&](std::size_t i) {
    return (rows[i % count + 1].slave - rows[i % count].slave) * pulses.slave_unit / length(i);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double apart = half(i) + half(i + 1);
    const double gradient = (ratio(i + 1) - ratio(i)) / apart;
    const double force =
        friction.viscous * ratio(i) + (ratio(i) == 0 ? 0 : std::copysign(friction.coulomb, ratio(i)));
    figures.squares += gradient * gradient * apart;
    figures.forces += gradient * gradient * apart + force * force * length(i);
    figures.ratio = std::max(figures.ratio, std::abs(ratio(i)));
    figures.gradient = std::max(figures.gradient, std::abs(gradient));
    figures.low = std::min(figures.low, rows[i].slave * pulses.slave_unit);
    figures.high = std::max(figures.high, rows[i].slave * pulses.slave_unit);
  }
  return figures;
}

double cost_of(const DesignJob& job, const CamFigures& figures) {
  if (job.goal == MoveGoal::peak) return figures.gradient;
  return job.goal == MoveGoal::energy ? figures.forces : figures.squares;
}

struct FittedRows {
  EcamRows rows;
  CamFigures figures;
  int begin = 0;
  double deviation = 0;
};

/// More rows follow the law more closely and let the rounding of each count for more: as many as cost a
/// hundredth by it, else those that cost least.
std::optional<FittedRows> best_rows(const DesignedCam& cam, const PulseJob& pulses, const DesignJob& job) {
  constexpr double by_rounding = 1.01;
  constexpr int least_pieces = 24;
  const double law = cost_of(job, figures_of(cam));
  const RowMaker maker(cam, pulses);
  std::optional<FittedRows> best;
  double least = 0;
  for (int pieces = least_pieces; pieces <= devices::lx3vp::max_rows - 4;
       pieces += std::max(1, pieces / 12)) {
    if (pulses.length - pulses.sync < 4 * pieces) break;
    auto rows = maker.rows(pieces);
    if (rows.size() > devices::lx3vp::max_rows) break;
    const auto figures = figures_of(rows, pulses, maker.begin(), cam.job);
    const double cost = std::max(cost_of(job, figures), by_rounding * law);
    if (!keeps_limits(job, figures) || (best && cost > least)) continue;
    const double deviation = maker.deviation(rows);
    best = FittedRows{std::move(rows), figures, maker.begin(), deviation};
    least = cost;
  }
  return best;
}

}  // namespace

std::optional<DeviceCam> fit_lx3vp(const DesignJob& job, const DesignAxes& axes, Problems& problems) {
  const auto pulses = in_pulses(job, axes, problems);
  if (!pulses) return {};
  auto stretched = job;
  stretched.sync = pulses->sync * pulses->master_unit;
  std::optional<FittedRows> fitted;
  fit_with_room(stretched, [&](const DesignedCam& cam) {
    fitted = best_rows(cam, *pulses, job);
    return fitted.has_value();
  });
  if (!fitted) {
    problems.push_back({"design.impossible"_code, "--device", 1, 1, "no rows of whole pulses keep the limits",
                        "give the limits a little more room, or shorter ways a pulse: --slave-pulse"});
    return {};
  }
  DeviceCam made{.job = stretched, .unit = "pulses"};
  devices::lx3vp::EcamTable table;
  table.rows = std::move(fitted->rows);
  if (job.max_travel) {
    table.travel.least = 0;
    table.travel.most = std::ceil(*job.max_travel / pulses->slave_unit);
  }
  if (job.speed) made.duty.master_speed = *job.speed / pulses->master_unit;
  if (job.speed && job.max_velocity) made.duty.max_velocity = *job.max_velocity / pulses->slave_unit;
  if (job.speed && job.max_acceleration)
    made.duty.max_acceleration = *job.max_acceleration / pulses->slave_unit;
  made.figures = fitted->figures;
  made.sync_begin = fitted->begin;
  made.sync_end = fitted->begin + pulses->sync;
  made.notes.push_back(
      fmt::format("{} rows, the law never more than {:.2f} pulses from the pieces between them",
                  table.rows.size(), fitted->deviation));
  made.table = table;
  return made;
}

}  // namespace drycut::sim::studies
