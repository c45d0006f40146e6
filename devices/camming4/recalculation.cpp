#include "devices/camming4/recalculation.hpp"

#include <algorithm>

namespace drycut::devices::camming4 {
namespace {

struct Calculation {
  int samples;  ///< 0 = none
  int shared;   ///< the variable that stands for all of one calculation
};

Calculation calculation_of(int variable) {
  switch (variable) {
    case VariableRow("codeG"):
    case VariableRow("codeQm"):
    case VariableRow("codeQs"):
    case VariableRow("codeQma"):
    case VariableRow("codeQsa"):
      return {1, VariableRow("codeG")};
    case VariableRow("maxpos"):
    case VariableRow("minpos"):
    case VariableRow("prspos"):
    case VariableRow("prsposm"):
    case VariableRow("toll"):
    case VariableRow("tacc"):
    case VariableRow("tdec"):
    case VariableRow("taccmax"):
    case VariableRow("tdecmax"):
    case VariableRow("syncrange"):
    case VariableRow("pgain"):
    case VariableRow("feedfw"):
    case VariableRow("integt"):
    case VariableRow("derivt"):
      return {1, variable};
    case VariableRow("tbfm"):
      return {2, variable};
    case VariableRow("tbf"):
      return {3, variable};
    case VariableRow("maxvel"):
      return {5, variable};
    case VariableRow("decpt"):
    case VariableRow("unitvel"):
      return {6, VariableRow("decpt")};
    case VariableRow("pulsem"):
    case VariableRow("measurem"):
      return {130, VariableRow("measurem")};
    case VariableRow("pulse"):
    case VariableRow("measure"):
      return {139, VariableRow("measure")};
    default:
      return {0, variable};
  }
}

}  // namespace

void Recalculation::written(int variable, int row) {
  const Calculation calculation = calculation_of(variable);
  if (calculation.samples == 0) return;
  const bool of_row = calculation.shared == VariableRow("codeG");
  const std::size_t number = of_row ? table::variables.size() + static_cast<std::size_t>(row)
                                    : static_cast<std::size_t>(calculation.shared);
  left_ += calculation.samples - of_each_[number];
  of_each_[number] = static_cast<std::uint8_t>(calculation.samples);
}

void Recalculation::sample() {
  if (left_ == 0) return;
  --left_;
  --*std::ranges::find_if(of_each_, [](std::uint8_t samples) { return samples > 0; });
}

}  // namespace drycut::devices::camming4
