#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "plants/guest.hpp"
#include "sim/fmi/host/frame.hpp"

namespace drycut::sim::fmi {

/// What modelDescription.xml says, as far as co-simulation needs it.
struct ForeignDescription {
  int version = 2;  ///< 2 or 3
  std::string model;
  std::string identifier;  ///< the library's name
  std::string token;
  std::string tool;
  bool keeps_state = false;
  double fixed_step = 0;  ///< [s]; 0 = any
  /// Inputs, outputs, parameters; of an array one for each element: "u[2]", "A[1,3]".
  std::vector<plants::GuestVariable> variables = {};
  /// How they are exchanged.
  struct Exchanged {
    host::SharedVariable variable;
    std::size_t first;  ///< of `variables`, followed by its other elements
  };
  std::vector<Exchanged> exchanged = {};
};

/// Reads it. What it says wrong throws scenario::GuestRefused. Texts and binaries that are inputs or outputs,
/// clocks, structural parameters and all that is local are left out.
ForeignDescription read_description(std::string_view xml);

}  // namespace drycut::sim::fmi
