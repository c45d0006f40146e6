#include <fmt/format.h>

#include <algorithm>

#include "devices/epicpos/positioner.hpp"
#include "devices/epicpos/rows.hpp"

namespace drycut::devices::epicpos {

bool Positioner::may_execute(int command) {
  return command != c_PRESET || state(st_still) || state(st_prson);
}

// The manual's programs give these whatever the state is: what holds already is no refusal.
bool Positioner::already_true(int command) const {
  switch (command) {
    case c_RESUME:
      return !state(st_emrg);
    case c_CALON:
      return state(st_cal);
    case c_CALOFF:
      return !state(st_cal);
    case c_REGOFF:
      return state(st_regoff);
    case c_REGON:
      return !state(st_regoff);
    default:
      return false;  // the others do no harm when repeated
  }
}

void Positioner::execute(int command) {
  switch (command) {
    case c_EMRG:
      rest();
      set_state(st_emrg, true);
      break;
    case c_RESUME:
      set_state(st_emrg, false);
      axis_.settle();
      break;
    case c_START:
      start_placement();
      break;
    case c_STOP:
      search_.abort();
      set_state(st_prson, false);
      axis_.stop();
      break;
    case c_PRESET:
      preset();
      break;
    case c_MANFW:
      start_manual(false);
      break;
    case c_MANBW:
      start_manual(true);
      break;
    case c_DELCNT:
      axis_.quota.add_um(value(v_delta), axis_.settings.resolution);
      break;
    default:
      execute_switch(command);
      break;
  }
}

void Positioner::execute_switch(int command) {
  switch (command) {
    case c_LOOPON:
      set_state(st_loopon, true);
      axis_.settle();
      break;
    case c_LOOPOFF:
      set_state(st_loopon, false);
      break;
    case c_CNTLOCK:
      set_state(st_cntlock, true);
      break;
    case c_CNTUNLOCK:
      set_state(st_cntlock, false);
      break;
    case c_CNTREV:
      set_state(st_cntrev, true);
      break;
    case c_CNTDIR:
      set_state(st_cntrev, false);
      break;
    case c_CALON:
      rest();
      set_state(st_cal, true);
      break;
    case c_CALOFF:
      set_state(st_cal, false);
      axis_.settle();
      break;
    case c_REGOFF:
      set_state(st_regoff, true);
      break;
    case c_REGON:
      set_state(st_regoff, false);
      axis_.settle();
      break;
    default:
      break;
  }
}

std::int32_t Positioner::clamped(std::int32_t quota) const {
  return std::max(value(v_minpos), std::min(quota, value(v_maxpos)));
}

// With the loop open the axis may have been moved by hand: a movement begins where it stands. A simulated
// axis only moves by itself, and keeps its part of a bit.
void Positioner::ready_to_move() {
  if (!state(st_loopon) && !terminals_.simulated) axis_.settle();
  set_state(st_still, false);
}

void Positioner::start_placement() {
  const std::int32_t wanted = value(v_setpos);
  const std::int32_t target = clamped(wanted);
  if (target != wanted)
    report({Diagnostic::Kind::note, "START",
            fmt::format("setpos {} is outside minpos..maxpos, the axis goes to {}", wanted, target)});
  ready_to_move();
  axis_.place(target, value(v_setvel));
}

void Positioner::start_manual(bool backward) {
  const std::int32_t limit = value(backward ? v_minpos : v_maxpos);
  if (backward ? value(v_posit) <= limit : value(v_posit) >= limit) {
    report(
        {Diagnostic::Kind::note, backward ? "MANBW" : "MANFW",
         fmt::format("posit {} is already at {} {}", value(v_posit), backward ? "minpos" : "maxpos", limit)});
    return;
  }
  ready_to_move();
  axis_.run(backward, limit, value(v_setvel));
}

void Positioner::preset() {
  if (search_.searching()) {
    search_.reverse(axis_);
    return;
  }
  if (value(v_prsmode) == 2) return;  // no search: the enable loads
  search_settings_ = {value(v_prsmode), value(v_prsdir) == 1, value(v_prspos),
                      value(v_prsvel),  value(v_sprsvel),     state(st_cntlock)};
  set_state(st_prson, true);
  set_state(st_prsok, false);
  ready_to_move();
  search_.start(search_settings_, terminals_.enable && terminals_.enable->level, axis_);
}

void Positioner::rest() {
  search_.abort();
  axis_.abort();
  set_state(st_prson, false);
  set_state(st_still, true);
}

}  // namespace drycut::devices::epicpos
