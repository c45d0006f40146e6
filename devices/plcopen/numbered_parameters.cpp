#include "devices/plcopen/axis.hpp"

#include <array>

#include "base/units.hpp"

namespace drycut::devices::plcopen {
namespace {

using P = AxisParameters;

template <double P::*member>
double parameter(const Axis& axis) {
  return axis.parameters().*member;
}
double largest_jerk(const Axis& axis) {
  return axis.parameters().a_max / 2 / (axis.parameters().tr_min * units::microsecond);
}

constexpr std::string_view position_unit = "0.1 um or 0.0001 deg";
constexpr std::string_view speed_unit = "um/s or 0.001 deg/s";
constexpr std::string_view slope_unit = "mm/s2 or deg/s2";

constexpr std::array numbered_rows{
    NumberedParameter{1, "CommandedPosition", position_unit,
                      [](const Axis& axis) { return axis.set().position.part; }, nullptr,
                      "commanded position"},
    NumberedParameter{2, "SWLimitPos", position_unit, &parameter<&P::swe_pos>, &P::swe_pos, "kenngr.swe_pos"},
    NumberedParameter{3, "SWLimitNeg", position_unit, &parameter<&P::swe_neg>, &P::swe_neg, "kenngr.swe_neg"},
    NumberedParameter{7, "MaxPositionLag", position_unit, &parameter<&P::following_error_max>,
                      &P::following_error_max, "following_error_max"},
    NumberedParameter{8, "MaxVelocitySystem", speed_unit, &parameter<&P::vb_max>, nullptr, "dynamik.vb_max"},
    NumberedParameter{9, "MaxVelocityAppl", speed_unit, &parameter<&P::vb_max>, &P::vb_max, "dynamik.vb_max"},
    NumberedParameter{10, "ActualVelocity", speed_unit,
                      [](const Axis& axis) { return axis.actual_velocity() / increments_per_speed; }, nullptr,
                      "speed by the encoder"},
    NumberedParameter{11, "CommandedVelocity", speed_unit,
                      [](const Axis& axis) { return axis.set().velocity / increments_per_speed; }, nullptr,
                      "commanded speed"},
    NumberedParameter{12, "MaxAccelerationSystem", slope_unit, &parameter<&P::a_max>, nullptr,
                      "dynamik.a_max"},
    NumberedParameter{13, "MaxAccelerationAppl", slope_unit, &parameter<&P::a_max>, &P::a_max,
                      "dynamik.a_max"},
    NumberedParameter{14, "MaxDecelerationSystem", slope_unit, &parameter<&P::a_max>, nullptr,
                      "dynamik.a_max"},
    NumberedParameter{15, "MaxDecelerationAppl", slope_unit, &parameter<&P::a_max>, nullptr,
                      "dynamik.a_max, written as number 13"},
    NumberedParameter{16, "MaxJerkSystem", "mm/s3 or deg/s3", largest_jerk, nullptr,
                      "half of dynamik.a_max in dynamik.tr_min"},
};

}  // namespace

std::span<const NumberedParameter> numbered_parameters() { return numbered_rows; }

const NumberedParameter* find_numbered_parameter(int number) {
  for (const NumberedParameter& row : numbered_rows)
    if (row.number == number) return &row;
  return nullptr;
}

ErrorId write_numbered_parameter(Axis& axis, int number, double value) {
  const NumberedParameter* row = find_numbered_parameter(number);
  if (row == nullptr || row->written == nullptr) return ErrorId::no_such_parameter;
  if (const CommandVerdict verdict = judge(axis.state(), Command::write_parameter);
      verdict.error != ErrorId::none)
    return verdict.error;
  AxisParameters wanted = axis.parameters();
  wanted.*row->written = value;
  const bool crossed = wanted.swe_neg > wanted.swe_pos;
  for (const AxisParameter& candidate : axis_parameter_table())
    if (candidate.is(row->written) && !crossed && axis.set_parameter(candidate, value)) return ErrorId::none;
  return ErrorId::parameter_range;
}

}  // namespace drycut::devices::plcopen
