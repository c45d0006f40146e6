#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "devices/cards.hpp"

namespace drycut::devices {

struct CamTable;  // devices/cam/table.hpp

/// The slave of a cam at an instant, in the units of the cam's table, to be compared with its law.
struct CamMoment {
  bool follows = false;               ///< a cam runs and its slave is on it; else the rest says nothing
  double master = 0;                  ///< as the cam counts it, on and on from cycle to cycle
  double set = 0;                     ///< where the device wants the slave, from where the cam has its zero
  double turn = 0;                    ///< `set` is known but for whole turns of this length; 0 = it is known
  std::optional<double> behind = {};  ///< set less measured position; absent: the device does not measure
};

/// An axis of a controller that can play cams, as a simulation looks at it. Stays valid as long as the
/// controller.
struct CamAxis {
  std::string name;  ///< "AxisX", "Y0", "Knife"
  std::optional<Address> pulses =
      {};  ///< output whose drive knows where the slave is, if the device does not
  /// Another number with each start and with each change of the table that the device takes over; 0 = no cam
  /// was started yet.
  std::function<std::uint64_t()> start;
  std::function<CamMoment()> moment;
  /// The table that it plays, or would play, with all that its law needs; null = it has none.
  std::function<std::shared_ptr<const CamTable>()> table;
};

}  // namespace drycut::devices
