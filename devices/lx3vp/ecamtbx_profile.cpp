#include "devices/lx3vp/ecamtbx.hpp"

namespace drycut::devices::lx3vp {

void CamProfile::add(double length, double r0, double r1, Transition shape) {
  // What rounding leaves of a length that is 0.
  constexpr double nothing = 1e-9;
  if (length <= nothing) return;
  if (r0 == r1) shape = Transition::constant;
  const bool goes_on = !pieces.empty() && shape == Transition::constant &&
                       !ratio_of(pieces.back()).is_curved() && ratio_of(pieces.back()).r0 == r0;
  if (goes_on)
    pieces.back().length += length;
  else
    pieces.push_back({master_length, length, slave_length, static_cast<int>(pieces.size()) + 1,
                      CamTransition{r0, r1, shape}});
  master_length += length;
  slave_length += length * (r0 + r1) / 2;
}

void CamProfile::mirror() {
  for (auto& piece : pieces) {
    auto& ratio = std::get<CamTransition>(piece.law);
    piece.slave = -piece.slave;
    ratio.r0 = -ratio.r0;
    ratio.r1 = -ratio.r1;
  }
  slave_length = -slave_length;
}

}  // namespace drycut::devices::lx3vp
