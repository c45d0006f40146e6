#include "sim/studies/design/sheet.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/units.hpp"
#include "sim/cams/motion_plot.hpp"
#include "sim/cams/report.hpp"
#include "sim/record/own_file.hpp"

namespace drycut::sim::studies {

namespace {

using cams::number_text;

std::string_view goal_text(MoveGoal goal) {
  switch (goal) {
    case MoveGoal::peak:
      return "the least largest acceleration";
    case MoveGoal::jerk:
      return "the least largest jerk";
    case MoveGoal::energy:
      return "the least copper loss with friction";
    default:
      return "the least rms acceleration";
  }
}

std::string job_text(const DesignJob& job) {
  std::string text;
  switch (job.kind) {
    case DesignKind::rotary_knife:
      text = fmt::format("Rotary knife: pieces of {}, {} from blade to blade{}, {} of it with the web",
                         length_text(job.length), length_text(job.slave),
                         job.blades > 1 ? fmt::format(" ({} on the drum)", job.blades) : "",
                         length_text(job.sync));
      break;
    case DesignKind::flying_saw:
      text = fmt::format("Flying saw: pieces of {}, {} of it with the tube", length_text(job.length),
                         length_text(job.sync));
      break;
    default:
      text = fmt::format("Feed: {} for {} of the master, at rest for {} of it", length_text(job.slave),
                         length_text(job.length), length_text(job.sync));
  }
  if (job.thickness > 0) text += fmt::format(", through {}", length_text(job.thickness));
  if (job.speed) text += fmt::format("; {}", velocity_text(*job.speed));
  return text;
}

std::string limits_text(const DesignJob& job) {
  std::vector<std::string> limits;
  if (job.max_velocity) limits.push_back(velocity_text(*job.max_velocity));
  if (job.max_acceleration) limits.push_back(acceleration_text(*job.max_acceleration));
  if (job.max_travel) limits.push_back(length_text(*job.max_travel) + " of travel");
  std::string text;
  for (const auto& limit : limits) text += (text.empty() ? ", within " : ", ") + limit;
  return text + (job.no_reverse ? ", never backwards" : "");
}

/// What was to be small, within which limits.
std::string aim_text(const DesignJob& job) { return std::string(goal_text(job.goal)) + limits_text(job); }

/// What there is to move beside the synchronous way.
std::string move_text(const DesignJob& job) {
  if (job.is_steady())
    return fmt::format(
        "nothing to optimise: pieces of {} are as long as the way from blade to blade, so the blade has the "
        "web's "
        "speed all the time; any other length needs its own cam\n",
        length_text(job.length));
  auto text = aim_text(job) + '\n';
  text += fmt::format("T = {}{} of the master are left to move in, by d = {}{}\n", length_text(job.way()),
                      job.speed ? fmt::format(" ({} ms)", number_text(1000 * job.way() / *job.speed, 7)) : "",
                      length_text(job.distance()), job.ratio() > 0 ? " against it" : "");
  if (job.thickness > 0)
    text += fmt::format(
        "along the web the blade has its speed: its own is up to {} of it where it is in the material, {} at "
        "the ends "
        "of the synchronous way\n",
        number_text(1 / (1 - job.thickness / job.radius()), 5), number_text(job.ratio(), 5));
  return text;
}

/// A cam's line of the table.
class SheetLine {
 public:
  SheetLine(const DesignJob& job, const CamFigures& figures) : job_(job), figures_(figures) {}

  [[nodiscard]] std::vector<std::string> cells(const std::string& name) const {
    const double v = job_.speed.value_or(1);
    const double rms = std::sqrt(figures_.squares / job_.length);
    std::vector<std::string> cells = {
        name,
        job_.is_steady() ? "-" : fmt::format("{:.4f}", factor_of(figures_, job_)),
        number(rms * v * v),
        number(figures_.gradient * v * v),
        has_jerk() ? number(figures_.jerk * v * v * v) : "-",
        number(figures_.ratio * v)};
    if (job_.kind == DesignKind::flying_saw)
      cells.push_back(
          figures_.high > figures_.low ? number((figures_.high - figures_.low) * units::millimetres) : "-");
    if (job_.goal == MoveGoal::energy)
      cells.push_back(figures_.forces > 0
                          ? number(job_.inertia * v * v * std::sqrt(figures_.forces / job_.length))
                          : "-");
    return cells;
  }

 private:
  /// There is more than the steps of the acceleration.
  [[nodiscard]] bool has_jerk() const { return figures_.jerk * job_.way() > 1e-3 * figures_.gradient; }
  static std::string number(double value) { return number_text(value, 5); }
  const DesignJob& job_;
  const CamFigures& figures_;
};

double goal_of(const DesignJob& job, const CamFigures& figures) {
  switch (job.goal) {
    case MoveGoal::peak:
      return figures.gradient;
    case MoveGoal::jerk:
      return figures.jerk;
    case MoveGoal::energy:
      return figures.forces;
    default:
      return figures.squares;
  }
}

/// What the fit costs of what was to be small.
std::string loss_text(const DesignSheet& sheet) {
  const double best = goal_of(sheet.cam.job, figures_of(sheet.cam));
  const double fitted = goal_of(sheet.cam.job, sheet.device->figures);
  const bool squared = sheet.cam.job.goal == MoveGoal::rms || sheet.cam.job.goal == MoveGoal::energy;
  if (best <= 0) return "";
  if (fitted <= 0) return "straight pieces have no jerk to compare";
  constexpr double shown = 0.005;
  const auto percent = [&](double of) {
    const double loss = 100 * (of / best - 1);
    return fmt::format("{:.2f} %", std::abs(loss) < shown ? 0 : loss);
  };
  auto text = fmt::format("the fit costs {} {}", percent(fitted), squared ? "copper loss" : "of it");
  const auto& least = sheet.device->least;
  if (least)
    text +=
        fmt::format("\n{}: no table of the device costs less than {}", sheet.device->why, percent(*least));
  return text;
}

std::string table_of_figures(const DesignSheet& sheet) {
  const auto& job = sheet.cam.job;
  const bool timed = job.speed.has_value();
  const auto unit = [&](const char* in_time, const char* of_master) { return timed ? in_time : of_master; };
  std::vector<cams::Columns::Heading> headings = {{"cam", "", true},
                                                  {"a^2 T^3/d^2", ""},
                                                  {"rms a", unit("m/s2", "1/m")},
                                                  {"peak a", unit("m/s2", "1/m")},
                                                  {"peak j", unit("m/s3", "1/m2")},
                                                  {"peak v", unit("m/s", "")}};
  if (job.kind == DesignKind::flying_saw) headings.push_back({"travel", "mm"});
  if (job.goal == MoveGoal::energy) headings.push_back({"rms force", "N"});
  cams::Columns columns(headings);
  const auto add = [&](const std::string& name, const CamFigures& figures) {
    columns.add(SheetLine(job, figures).cells(name));
  };
  add("designed", figures_of(sheet.cam));
  if (sheet.device) add("as " + sheet.device_name + " plays it", sheet.device->figures);
  if (!job.is_steady())
    for (const auto& move : {quintic, cycloid}) add(move.name, figures_of(move, job));
  return columns.text();
}

const char* sync_text(const DesignJob& job) { return job.ratio() > 0 ? "synchronous" : "at rest"; }

std::string device_text(const DesignSheet& sheet) {
  const auto& device = *sheet.device;
  auto text = fmt::format("{}: ", sheet.device_name);
  for (const auto& note : device.notes) text += note + "; ";
  text += loss_text(sheet) + '\n';
  if (device.job.sync > 0)
    text += fmt::format("{} from master {:.0f} to {:.0f} {}", sync_text(device.job), device.sync_begin,
                        device.sync_end, device.unit);
  const double longer = device.job.sync - sheet.cam.job.sync;
  if (longer > 1e-9) text += fmt::format(", {} longer than asked for", length_text(longer));
  return text + (device.job.sync > 0 ? "\n" : "") + cams::findings_text(sheet.findings);
}

/// A panel's curve of the law, and of the quintic behind it.
renders::Panel panel_of(const DesignSheet& sheet, const char* title, const std::string& unit, int order,
                        double scale) {
  const auto& job = sheet.cam.job;
  constexpr int points = 2000;
  renders::Panel panel;
  panel.title = title;
  panel.y_label = fmt::format("[{}]", unit);
  const auto pick = [&](const devices::CamMotion& motion) {
    const double numbers[] = {motion.position, motion.velocity, motion.acceleration, motion.jerk};
    return numbers[order] * scale;
  };
  renders::Curve cam{"designed", {}, {}};
  for (const auto& piece : sheet.cam.law.pieces)
    for (const double master : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      cam.x.push_back((piece.master + master * piece.length) * units::millimetres);
      cam.y.push_back(pick(piece.at(master * piece.length)));
    }
  renders::Curve other{"quintic", {}, {}, renders::Curve::Style::line, true};
  const double d = job.distance();
  const double way = job.way();
  for (int i = 0; i <= points; ++i) {
    const double u = static_cast<double>(i) / points;
    devices::CamMotion motion;
    motion.position = job.sync_slave() + job.ratio() * u * way + d * u * u * u * (10 + u * (6 * u - 15));
    motion.velocity = job.ratio() + 30 * d / way * u * u * (1 - u) * (1 - u);
    motion.acceleration = 60 * d / (way * way) * u * (1 - u) * (1 - 2 * u);
    motion.jerk = 60 * d / (way * way * way) * (1 - 6 * u + 6 * u * u);
    other.x.push_back((job.sync + u * way) * units::millimetres);
    other.y.push_back(pick(motion));
  }
  panel.curves = {std::move(other), std::move(cam)};
  return panel;
}

}  // namespace

std::string remarks_text(const DesignSheet& sheet) {
  const auto& job = sheet.cam.job;
  return fmt::format("## {} design: {}.\n## {}.\n", record::own_mark, job_text(job),
                     job.is_steady() ? "at the web's speed all the time" : aim_text(job));
}

std::string sheet_text(const DesignSheet& sheet) {
  const auto& job = sheet.cam.job;
  auto text = fmt::format("{}\n{}", job_text(job), move_text(job));
  text += '\n' + table_of_figures(sheet);
  if (sheet.device) text += '\n' + device_text(sheet);
  return text;
}

renders::Plot design_plot(const DesignSheet& sheet) {
  const auto& job = sheet.cam.job;
  const double v = job.speed.value_or(1);
  const bool timed = job.speed.has_value();
  renders::Plot plot;
  plot.name = "design";
  plot.title = job_text(job) + ": " + std::string(goal_text(job.goal));
  plot.x_label = "master [mm]";
  plot.width = 1600;
  plot.panel_height = 240;
  plot.panels = {
      panel_of(sheet, "slave position", "mm", 0, units::millimetres),
      panel_of(sheet, "velocity", timed ? "m/s" : "slave/master", 1, v),
      panel_of(sheet, "acceleration", timed ? "m/s2" : "1/m", 2, v * v),
      panel_of(sheet, "jerk, between the steps of acceleration", timed ? "m/s3" : "1/m2", 3, v * v * v)};
  std::vector<cams::CamZone> zones;
  if (job.sync > 0) zones.push_back({0, job.sync * units::millimetres, sync_text(job), true});
  zones.push_back({job.sync * units::millimetres, job.length * units::millimetres, "to the next", false});
  cams::draw_zones(plot, zones);
  if (timed) plot.second_x = renders::SecondScale{"time [s]", 1 / (v * units::millimetres)};
  return plot;
}

}  // namespace drycut::sim::studies
