#pragma once
#include <array>
#include <string>
#include <string_view>

namespace drycut {

/// A device's unit as the report shows it; its files keep the device's own.
struct ShownUnit {
  std::string unit;   ///< "deg" of "0.0001 deg"; one that people read already as it is
  double factor = 1;  ///< of it in one of the device's
};

/// Units of kernels and parameters, whose numbers are whole there, as people read them. A user's unit (Um)
/// and a transducer's bits have no row: how large they are is the machine builder's choice, and the program
/// counts in them.
struct ShownUnitRow {
  std::string_view unit;
  std::string_view shown;
  double factor;
};
inline constexpr std::array shown_unit_rows = {
    ShownUnitRow{"0.1 um", "mm", 1e-4},
    ShownUnitRow{"0.0001 deg", "deg", 1e-4},
    ShownUnitRow{"um", "mm", 1e-3},
    ShownUnitRow{"um/s", "mm/s", 1e-3},
    ShownUnitRow{"um/s2", "mm/s2", 1e-3},
    ShownUnitRow{"um/s3", "mm/s3", 1e-3},
    ShownUnitRow{"0.001 deg/s", "deg/s", 1e-3},
    ShownUnitRow{"0.001 deg/s2", "deg/s2", 1e-3},
    ShownUnitRow{"0.001 deg/s3", "deg/s3", 1e-3},
    ShownUnitRow{"0.1 V", "V", 0.1},
    ShownUnitRow{"0.1 ms", "ms", 0.1},
    ShownUnitRow{"1/100 s", "s", 0.01},
};

/// What a reader who does not know the controller must be told of a unit that stays as the device has it.
struct UnitMeaningRow {
  std::string_view unit;  ///< also as part of another: "Um/s", "bits x4/s"
  std::string_view meaning;
};
inline constexpr std::array unit_meaning_rows = {
    UnitMeaningRow{"bits x4", "counts of the encoder, four for each of its lines"},
    UnitMeaningRow{"Um", "the axis' own unit of measurement, as its parameters measure and pulse define it"},
};

inline ShownUnit shown_unit(std::string_view unit) {
  for (const auto& row : shown_unit_rows)
    if (row.unit == unit) return {std::string(row.shown), row.factor};
  return {std::string(unit), 1};
}

}  // namespace drycut
