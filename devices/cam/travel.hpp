#pragma once
#include <optional>

namespace drycut::devices {

/// From where to where the slave's machine lets it go, in its unit, from the place where the cam counts 0.
/// No device watches it in a cam; `drycut cam` does, before a carriage meets its end stop.
struct CamTravel {
  std::optional<double> least = {};
  std::optional<double> most = {};

  [[nodiscard]] bool is_given() const { return least || most; }
  bool operator==(const CamTravel&) const = default;
};

}  // namespace drycut::devices
