#include "devices/axis/limits.hpp"
#include "devices/epicpos/positioner.hpp"
#include "devices/terminals.hpp"

namespace drycut::devices::epicpos {

bool Positioner::may_execute(int command) {
  return command != CommandRow("PRESET") || state("st_still") || state("st_prson");
}

void Positioner::execute(int command) {
  switch (command) {
    case CommandRow("EMRG"):
    case CommandRow("CALON"):
      rest();
      break;
    case CommandRow("RESUME"):
    case CommandRow("LOOPON"):
    case CommandRow("CALOFF"):
    case CommandRow("REGON"):
      axis_.settle();
      break;
    case CommandRow("START"):
      start_placement();
      break;
    case CommandRow("STOP"):
      search_.abort();
      set_state("st_prson", false);
      axis_.stop();
      break;
    case CommandRow("PRESET"):
      preset();
      break;
    case CommandRow("MANFW"):
      start_manual(false);
      break;
    case CommandRow("MANBW"):
      start_manual(true);
      break;
    case CommandRow("DELCNT"):
      axis_.quota.add_um(value("delta"), axis_.settings.resolution);
      break;
    default:
      break;
  }
}

std::int32_t Positioner::clamped(std::int32_t quota) const {
  return axis::held(quota, value("minpos"), value("maxpos"));
}

/// What every movement begins with.
void Positioner::depart() {
  if (value("maxvel") <= 0) report(axis::without_maxvel(value("maxvel")));
  set_state("st_still", false);
}

void Positioner::start_placement() {
  const std::int32_t wanted = value("setpos");
  const std::int32_t target = clamped(wanted);
  if (target != wanted) report(axis::outside_limits(wanted, target));
  depart();
  axis_.place(target, value("setvel"));
}

void Positioner::start_manual(bool backward) {
  const std::int32_t limit = backward ? value("minpos") : value("maxpos");
  if (axis::at_limit(backward, value("posit"), limit)) {
    report(axis::no_way_left(backward, value("posit"), limit));
    return;
  }
  depart();
  axis_.run(backward, limit, value("setvel"));
}

void Positioner::preset() {
  if (search_.searching()) {
    search_.reverse(axis_);
    return;
  }
  if (value("prsmode") == 2) return;  // no search: the enable loads
  search_settings_ = {value("prsmode"), value("prsdir") == 1, value("prspos"),
                      value("prsvel"),  value("sprsvel"),     state("st_cntlock")};
  set_state("st_prson", true);
  set_state("st_prsok", false);
  depart();
  search_.start(search_settings_, is_on(terminals_.enable), axis_);
}

void Positioner::rest() {
  search_.abort();
  axis_.abort();
  set_state("st_prson", false);
  set_state("st_still", true);
}

}  // namespace drycut::devices::epicpos
