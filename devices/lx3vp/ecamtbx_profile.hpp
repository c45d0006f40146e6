#pragma once
#include "devices/cam/law.hpp"

namespace drycut::devices::lx3vp {

/// A cam cycle as ECAMTBX constructs it (003 6.3 and its appendix), before anything is rounded to pulses: the
/// ratio of the slave to the master over the master's position, as a row of transitions [pulses].
struct CamProfile : CamLaw {
  double sync_begin = 0;  ///< of the synchronous zone on the master; equal to `sync_end`: there is none
  double sync_end = 0;
  bool stops = false;  ///< midCAMend: the cam stops by itself at the end of the cycle

  [[nodiscard]] bool is_synchronous(double master) const { return master > sync_begin && master < sync_end; }
  /// Appends a piece; one without length is left out, one that goes on at the same constant ratio is joined.
  void add(double length, double r0, double r1, Transition shape);
  /// The same profile run in the opposite direction.
  void mirror();
};

}  // namespace drycut::devices::lx3vp
