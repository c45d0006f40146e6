#include "devices/axis/limits.hpp"
#include "devices/epicpos/positioner.hpp"
#include "devices/epicpos/rows.hpp"
#include "devices/terminals.hpp"

namespace drycut::devices::epicpos {

bool Positioner::may_execute(int command) {
  return command != c_PRESET || state(st_still) || state(st_prson);
}

void Positioner::execute(int command) {
  switch (command) {
    case c_EMRG:
    case c_CALON:
      rest();
      break;
    case c_RESUME:
    case c_LOOPON:
    case c_CALOFF:
    case c_REGON:
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
      break;
  }
}

std::int32_t Positioner::clamped(std::int32_t quota) const {
  return axis::held(quota, value(v_minpos), value(v_maxpos));
}

/// What every movement begins with.
void Positioner::depart() {
  if (value(v_maxvel) <= 0) report(axis::without_maxvel(value(v_maxvel)));
  set_state(st_still, false);
}

void Positioner::start_placement() {
  const std::int32_t wanted = value(v_setpos);
  const std::int32_t target = clamped(wanted);
  if (target != wanted) report(axis::outside_limits(wanted, target));
  depart();
  axis_.place(target, value(v_setvel));
}

void Positioner::start_manual(bool backward) {
  const std::int32_t limit = value(backward ? v_minpos : v_maxpos);
  if (axis::at_limit(backward, value(v_posit), limit)) {
    report(axis::no_way_left(backward, value(v_posit), limit));
    return;
  }
  depart();
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
  depart();
  search_.start(search_settings_, is_on(terminals_.enable), axis_);
}

void Positioner::rest() {
  search_.abort();
  axis_.abort();
  set_state(st_prson, false);
  set_state(st_still, true);
}

}  // namespace drycut::devices::epicpos
