#include "devices/axis/analogue_axis.hpp"

namespace drycut::devices::axis {

void PresetSearch::start(const PresetSettings& settings, bool enable, AnalogueAxis& axis) {
  last_enable_ = enable;
  backward_ = enable ? !settings.backward : settings.backward;
  leg_ = enable ? Leg::leave : Leg::approach;
  axis.run(backward_, std::nullopt, speed(settings));
}

void PresetSearch::reverse(AnalogueAxis& axis) {
  if (leg_ == Leg::none || leg_ == Leg::halt || leg_ == Leg::place) return;
  backward_ = !backward_;
  after_turn_ = leg_ == Leg::turn ? after_turn_ : leg_;
  leg_ = Leg::turn;
  axis.stop();
}

bool PresetSearch::sample(const PresetSettings& settings, bool enable, std::optional<std::int64_t> zero,
                          AnalogueAxis& axis) {
  const bool released = last_enable_ && !enable;
  last_enable_ = enable;
  switch (leg_) {
    case Leg::approach:
      if (!enable) return false;
      backward_ = !backward_;
      after_turn_ = Leg::leave;
      leg_ = Leg::turn;
      axis.stop();
      return false;
    case Leg::turn:
      // Turned by the program, the axis can still run into the enable before it stands.
      if (enable && after_turn_ == Leg::approach) after_turn_ = Leg::leave;
      if (axis.profile().moving()) return false;
      leg_ = after_turn_;
      axis.run(backward_, std::nullopt, speed(settings));
      return false;
    case Leg::leave:
      if (!released || (settings.mode == 0 && settings.locked)) return false;
      if (settings.mode == 0) {
        load(settings, axis.transducer().total(), axis);
        return true;
      }
      leg_ = Leg::zero_pulse;
      return false;
    case Leg::zero_pulse:
      if (!zero || settings.locked) return false;
      load(settings, *zero, axis);
      return true;
    case Leg::halt:
      if (axis.profile().moving()) return false;
      leg_ = Leg::place;
      axis.place(settings.quota, settings.slow);
      return false;
    case Leg::none:
    case Leg::place:
      break;
  }
  return false;
}

void PresetSearch::load(const PresetSettings& settings, std::int64_t total, AnalogueAxis& axis) {
  axis.quota.set_um(settings.quota, axis.settings.resolution);
  axis.quota.count(axis.transducer().total() - total, axis.settings.resolution);
  leg_ = Leg::halt;
  axis.stop();
}

bool PresetSearch::finished(const AnalogueAxis& axis) {
  if (leg_ != Leg::place || axis.profile().moving()) return false;
  leg_ = Leg::none;
  return true;
}

}  // namespace drycut::devices::axis
