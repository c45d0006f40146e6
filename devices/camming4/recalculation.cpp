#include "devices/camming4/recalculation.hpp"

#include <algorithm>

#include "devices/camming4/rows.hpp"

namespace drycut::devices::camming4 {
namespace {

struct Calculation {
  int samples;  ///< 0 = none
  int shared;   ///< the variable that stands for all of one calculation
};

Calculation calculation_of(int variable) {
  switch (variable) {
    case v_codeG:
    case v_codeQm:
    case v_codeQs:
    case v_codeQma:
    case v_codeQsa:
      return {1, v_codeG};
    case v_maxpos:
    case v_minpos:
    case v_prspos:
    case v_prsposm:
    case v_toll:
    case v_tacc:
    case v_tdec:
    case v_taccmax:
    case v_tdecmax:
    case v_syncrange:
    case v_pgain:
    case v_feedfw:
    case v_integt:
    case v_derivt:
      return {1, variable};
    case v_tbfm:
      return {2, variable};
    case v_tbf:
      return {3, variable};
    case v_maxvel:
      return {5, variable};
    case v_decpt:
    case v_unitvel:
      return {6, v_decpt};
    case v_pulsem:
    case v_measurem:
      return {130, v_measurem};
    case v_pulse:
    case v_measure:
      return {139, v_measure};
    default:
      return {0, variable};
  }
}

}  // namespace

void Recalculation::written(int variable, int row) {
  const Calculation calculation = calculation_of(variable);
  if (calculation.samples == 0) return;
  const bool of_row = calculation.shared == v_codeG;
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
