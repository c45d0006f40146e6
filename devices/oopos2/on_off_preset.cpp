#include <utility>

#include "devices/device.hpp"
#include "devices/oopos2/on_off_positioner.hpp"

// The preset search (001 1.4.8; spec qem.md 5.11 and 9.7).
namespace drycut::devices::oopos2 {

void OnOffPositioner::preset() {
  if (search_ == Search::halt || search_ == Search::place) return;
  if (search_ != Search::none) {
    search_leg(search_, !search_backward_);
    return;
  }
  if (value("prsmode") == 2) return;  // no search: the enable loads
  set_state("st_toll", false);  // st_sttoll stays: a search is none of the commands that end it (001 1.6.4)
  set_state("st_prson", true);
  set_state("st_prsok", false);
  set_state("st_still", false);
  search_slow_ = value("prsdir") == 2 || value("prsdir") == 3;
  search_zero_ = value("prsmode") == 1;
  const bool backward = value("prsdir") == 1 || value("prsdir") == 3;
  const bool enable = is_on(enable_);
  search_leg(enable ? Search::leave : Search::approach, enable ? !backward : backward);
}

void OnOffPositioner::end_search() {
  search_ = Search::none;
  set_state("st_prson", false);
}

void OnOffPositioner::search_leg(Search search, bool backward) {
  search_ = search;
  search_backward_ = backward;
  movement_.run({backward, search_slow_ || search != Search::approach, false, std::nullopt, 0});
}

void OnOffPositioner::sample_preset() {
  const bool enable = is_on(enable_);
  const bool released = std::exchange(enable_was_, enable) && !enable;
  const auto zero = std::exchange(zero_, std::nullopt);
  if (!enable) enable_released_ = true;
  if (search_ != Search::none) {
    sample_search(enable, released, zero);
  } else if (value("prsmode") == 2 && enable && enable_released_ && !state("st_cntlock")) {
    quota_.set_um(value("prspos"), resolution_);
    set_state("st_prsok", true);
  }
}

void OnOffPositioner::sample_search(bool enable, bool released, std::optional<std::int64_t> zero) {
  switch (search_) {
    case Search::approach:
      if (!enable) return;
      // Turned by the program, the axis can still run into the enable: it leaves it the way it turns to.
      search_leg(Search::leave,
                 movement_.phase() == MovementPhase::inversion ? search_backward_ : !search_backward_);
      return;
    case Search::leave:
      // An edge while the axis still coasts the other way is not the one that the slow leg looks for.
      if (!released || !movement_.running()) return;
      if (search_zero_)
        search_ = Search::zero_pulse;
      else if (!state("st_cntlock"))
        load(transducer_.total());
      return;
    case Search::zero_pulse:
      if (zero && !state("st_cntlock")) load(*zero);
      return;
    default:
      return;
  }
}

/// The quota belongs to where the count was at `total`; the axis stops and goes there.
void OnOffPositioner::load(std::int64_t total) {
  quota_.set_um(value("prspos"), resolution_);
  quota_.count(transducer_.total() - total, resolution_);
  search_ = Search::halt;
  movement_.stop();
}

}  // namespace drycut::devices::oopos2
