#pragma once
#include <string>

#include "base/problem.hpp"
#include "devices/plcopen/axis_parameters.hpp"
#include "devices/plcopen/cam_table.hpp"
#include "devices/plcopen/errors.hpp"
#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/pins.hpp"
#include "tests/devices/coverage.hpp"

namespace drycut::devices::plcopen {

/// What the tests of the PLCopen kernel must show (coverage.hpp): every pin ("MC_CamIn.InSync"), parameter,
/// error number, bit of StartMode, interpolation and type of table ("type 3").
inline coverage::Marks all_marks() {
  coverage::Marks marks;
  for (const BlockType& type : block_types())
    for (const Pin& pin : type.pins) marks.insert(std::string(type.name) + "." + std::string(pin.name));
  for (const AxisParameter& parameter : axis_parameter_table()) marks.emplace(parameter.name);
  for (const ErrorRow& row : error_table) marks.insert(std::to_string(static_cast<unsigned>(row.id)));
  for (const StartModeRow& row : start_mode_table) marks.emplace(row.name);
  for (unsigned i = 0; i <= 6; ++i) marks.emplace(name_of(static_cast<Interpolation>(i)));
  for (int i = 1; i <= 7; ++i) marks.insert("type " + std::to_string(i));
  return marks;
}

inline void covers(std::initializer_list<std::string> names) {
  static const coverage::Marks known = all_marks();
  coverage::cover(known, names);
}

/// Pins of one block.
inline void covers(const std::string& block, std::initializer_list<const char*> pins) {
  for (const char* pin : pins) covers({block + "." + pin});
}

}  // namespace drycut::devices::plcopen
