#include "devices/plcopen/axis_parameters.hpp"

#include <array>
#include <cmath>
#include <type_traits>

#include "base/state_archive.hpp"

namespace drycut::devices::plcopen {
namespace {

using P = AxisParameters;
constexpr double most = 2147483647;
constexpr double unsigned_most = 4294967295;

constexpr std::array parameter_rows{
    AxisParameter{"kind", "", "", 0, 2, true, &P::kind,
                  "0 servo with +-10 V reference, 1 virtual, 2 encoder only"},
    AxisParameter{"modulo", "", "0.1 um, 0.0001 deg", 0, most, true, &P::modulo,
                  "length of a turn of a modulo axis; 0 = linear axis"},
    AxisParameter{"dynamik.vb_max", "P-AXIS-00212", "um/s, 0.001 deg/s", 1, most, false, &P::vb_max,
                  "largest speed"},
    AxisParameter{"dynamik.a_max", "P-AXIS-00008", "mm/s2, deg/s2", 1, most, false, &P::a_max,
                  "largest acceleration; commands without their own take half of it"},
    AxisParameter{"dynamik.tr_min", "P-AXIS-00201", "us", 1, unsigned_most, false, &P::tr_min,
                  "shortest time in which a_max is built up; no jerk is larger than a_max/2 in it"},
    AxisParameter{"dynamik.tr_max", "", "us", 1, unsigned_most, false, &P::tr_max,
                  "longest such time: the jerk of velocity synchronisation where j_vel_sync is 0"},
    AxisParameter{"getriebe[0].lslope_profil.a_grenz_stufe_1", "", "mm/s2, deg/s2", 1, most, false,
                  &P::a_grenz_stufe_1, "deceleration of emergency stop and Errorstop, not jerk-limited"},
    AxisParameter{"kenngr.swe_neg", "P-AXIS-00177", "0.1 um", -most, most, false, &P::swe_neg,
                  "negative software limit of a homed linear axis; equal to the positive one = none"},
    AxisParameter{"kenngr.swe_pos", "P-AXIS-00178", "0.1 um", -most, most, false, &P::swe_pos,
                  "positive software limit of a homed linear axis"},
    AxisParameter{"getriebe[0].window", "", "0.1 um, 0.0001 deg", 0, most, false, &P::window,
                  "MC_MoveAbsolute is done when the actual position is this near"},
    AxisParameter{"path_increments", "", "0.1 um, 0.0001 deg", 1, most, true, &P::path_increments,
                  "way of path_counts counts of the encoder"},
    AxisParameter{"path_counts", "", "counts x4", 1, most, true, &P::path_counts, "see path_increments"},
    AxisParameter{"homed_at_start", "", "", 0, 1, true, &P::homed_at_start,
                  "1: an absolute encoder, or a virtual axis, homed without MC_Home; in a scenario the "
                  "default of virtual ones"},
    AxisParameter{"antr.v_at_10v", "", "um/s, 0.001 deg/s", 1, most, false, &P::v_at_10v,
                  "speed of the drive at 10 V"},
    AxisParameter{"kv", "P-AXIS-00099", "0.01/s", 0, 100'000, false, &P::kv,
                  "gain of the position controller: speed for following error"},
    AxisParameter{"feed_forward", "", "0.1 %", 0, 2'000, false, &P::feed_forward,
                  "share of the commanded speed that goes to the drive directly"},
    AxisParameter{"following_error_max", "", "0.1 um, 0.0001 deg", 0, most, false, &P::following_error_max,
                  "largest following error; 0 = not supervised"},
    AxisParameter{"cam_gear.is_master", "P-AXIS-00288", "", 0, 1, true, &P::is_master,
                  "1: the axis may be the master of couplings"},
    AxisParameter{"cam_gear.v_diff_percent", "P-AXIS-00289", "0.1 %", 0, 1'000, false, &P::v_diff_percent,
                  "velocity window, of the cam's speed"},
    AxisParameter{"cam_gear.time_in_window", "P-AXIS-00290", "us", 0, unsigned_most, false,
                  &P::time_in_window, "time without a break in the window until speeds count as equal"},
    AxisParameter{"cam_gear.time_out_in_window", "P-AXIS-00291", "us", 0, unsigned_most, false,
                  &P::time_out_in_window, "longest time for it, from the first entry into the window"},
    AxisParameter{"cam_gear.timeout_from_execute", "", "", 0, 1, true, &P::timeout_from_execute,
                  "1: that time counts from the command"},
    AxisParameter{"cam_gear.average_filter", "P-AXIS-00300", "", 0, 1, true, &P::average_filter,
                  "of an encoder's speed: 1 = mean of filter_cycles cycles"},
    AxisParameter{"cam_gear.filter_cycles", "P-AXIS-00301", "cycles", 1, 1'000, true, &P::filter_cycles,
                  "see average_filter"},
    AxisParameter{"cam_gear.delay_time", "P-AXIS-00302", "us", 0, 1e7, false, &P::delay_time,
                  "of a slave on actual values: dead time by which the master's position is carried on"},
    AxisParameter{"cam_gear.v_max_slave", "P-AXIS-00303", "um/s, 0.001 deg/s", 0, most, false,
                  &P::v_max_slave, "largest commanded speed of a slave; 0 = vb_max"},
    AxisParameter{"cam_gear.a_max_slave", "P-AXIS-00304", "mm/s2, deg/s2", 0, most, false, &P::a_max_slave,
                  "largest commanded acceleration of a geared slave; 0 = a_max"},
    AxisParameter{"cam_gear.v_phasing", "P-AXIS-00305", "um/s, 0.001 deg/s", 1, most, false, &P::v_phasing,
                  "speed of the phase synchronisation; vb_max/2 at most"},
    AxisParameter{"cam_gear.a_phasing", "P-AXIS-00306", "mm/s2, deg/s2", 1, most, false, &P::a_phasing,
                  "its acceleration; a_max/2 at most"},
    AxisParameter{"cam_gear.d_phasing", "P-AXIS-00307", "mm/s2, deg/s2", 1, most, false, &P::d_phasing,
                  "its deceleration; a_max/2 at most"},
    AxisParameter{"cam_gear.j_phasing", "P-AXIS-00376", "mm/s3, deg/s3", 1, most, false, &P::j_phasing,
                  "its jerk; (a_max/2)/tr_min at most"},
    AxisParameter{"cam_gear.j_vel_sync", "P-AXIS-00377", "mm/s3, deg/s3", 0, most, false, &P::j_vel_sync,
                  "jerk of the velocity synchronisation; 0 = (a_max/2)/tr_max"},
    AxisParameter{"cam_gear.keep_coupling_on_lr_error", "P-AXIS-00308", "", 0, 1, true,
                  &P::keep_coupling_on_lr_error, "1: emergency stop does not release the coupling"},
    AxisParameter{"cam_gear.keep_coupling_on_fe_drop", "P-AXIS-00309", "", 0, 1, true,
                  &P::keep_coupling_on_fe_drop, "1: neither does a drop of the feed enable"},
};

}  // namespace

std::span<const AxisParameter> axis_parameter_table() { return parameter_rows; }

const AxisParameter* find_axis_parameter(std::string_view name) {
  for (const AxisParameter& parameter : parameter_rows)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

std::string_view unit_of(const AxisParameter& parameter, Measure measure) {
  const auto comma = parameter.unit.find(", ");
  if (comma == std::string_view::npos) return parameter.unit;
  return measure == Measure::length ? parameter.unit.substr(0, comma) : parameter.unit.substr(comma + 2);
}

void AxisParameters::visit(StateArchive& archive) {
  for (const AxisParameter& parameter : parameter_rows)
    std::visit([&](auto place) { archive.named(parameter.name, this->*place); }, parameter.member);
}

bool set_parameter(AxisParameters& parameters, const AxisParameter& parameter, double value) {
  if (!(value >= parameter.min && value <= parameter.max)) return false;
  if (parameter.whole && value != std::round(value)) return false;
  std::visit(
      [&](auto place) {
        parameters.*place = static_cast<std::remove_reference_t<decltype(parameters.*place)>>(value);
      },
      parameter.member);
  return true;
}

}  // namespace drycut::devices::plcopen
