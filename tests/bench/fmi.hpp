#pragma once

namespace drycut::bench {

/// What the functions of FMI add to a step of the knife's machine at 100 us [us].
struct FmiCost {
  double native = 0;   ///< of a step of the machine alone
  double do_step = 0;  ///< of fmi2DoStep, which does one
  double state = 0;    ///< of getting the state of the FMU and going back to it
};
/// The best of `rounds` rounds.
FmiCost fmi_cost(int rounds);

/// A line for people: "fmi2DoStep: 1.43 us a step, the machine alone 1.40 us: 2 % more, ...".
void print_fmi_cost(int rounds);

}  // namespace drycut::bench
