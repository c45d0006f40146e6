#pragma once
#include <span>
#include <string_view>

#include "devices/plcopen/axis.hpp"

namespace drycut::devices::plcopen {

/// A parameter of an axis by PLCopen's number (part 1, table of parameters), as MC_ReadParameter gives it.
/// ISG's own blocks take the machine data's names as texts instead.
struct NumberedParameter {
  int number = 0;
  std::string_view name;
  std::string_view unit;
  double (*read)(const Axis& axis) = nullptr;
  double AxisParameters::*written = nullptr;  ///< nullptr: MC_WriteParameter refuses it
  std::string_view meaning;
};
/// Those with a number as value; the BOOL ones (4, 5, 6) are none of them.
std::span<const NumberedParameter> numbered_parameters();
/// nullptr if there is none.
const NumberedParameter* find_numbered_parameter(int number);
/// MC_WriteParameter: in Standstill and Disabled only, as ISG demands. 65020 if it cannot be written, 65021
/// if the value is out of its range or the software limits would cross.
ErrorId write_numbered_parameter(Axis& axis, int number, double value);

}  // namespace drycut::devices::plcopen
