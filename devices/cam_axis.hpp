#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "devices/cards.hpp"

namespace drycut::devices {

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
  std::string name;       ///< "AxisX", "Y0", "Knife"
  std::string_view kind;  ///< of its tables: "camming4", "lx3vp", "mc_camin"
  std::optional<Address> pulses =
      {};  ///< output whose drive knows where the slave is, if the device does not
  /// Another number with each start and with each change of the table that the device takes over; 0 = no cam
  /// was started yet.
  std::function<std::uint64_t()> start;
  std::function<CamMoment()> moment;
  /// The table that it plays, or would play, with all that its law needs, as cam tables are written: settings
  /// `# key: value`, a header, the rows (CAMMING4 `sector,codeG,...`; LX3VP `master,slave` or ECAMTBX's
  /// `parameter,value`; MC_CamIn `slave`, `master,slave` or `a0,a1,a2,a3`). "" = it has none.
  std::function<std::string()> table;
};

}  // namespace drycut::devices
