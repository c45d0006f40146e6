// What of an axis is state.
#include "base/state_archive.hpp"
#include "devices/axis/analogue_axis.hpp"

namespace drycut::devices::axis {

void Resolution::visit(StateArchive& archive) { STATE(archive, measure, pulse); }
void Transducer::visit(StateArchive& archive) { STATE(archive, last_, total_); }
void Quota::visit(StateArchive& archive) { STATE(archive, numerator_); }
void Theoretical::visit(StateArchive& archive) { STATE(archive, whole, part); }
void FrequencyMeter::visit(StateArchive& archive) { STATE(archive, bits_, elapsed_ms_, bits_per_second_); }

void Ramp::visit(StateArchive& archive) { STATE(archive, from, to, duration); }
void Demand::visit(StateArchive& archive) {
  STATE(archive, speed, seconds_per_speed_up, seconds_per_speed_down, shape, keep_gradient);
}
void Plan::visit(StateArchive& archive) { STATE(archive, shape, lead, first, constant, last); }
void Profile::visit(StateArchive& archive) {
  STATE(archive, plan_, demand_, direction_, distance_, covered_, time_, begun_, periods_, moving_,
        stopping_);
}

void DacOutput::visit(StateArchive& archive) { STATE(archive, word, saturated); }
void DacTurn::visit(StateArchive& archive) { STATE(archive, turn_); }
void FollowingErrorHold::visit(StateArchive& archive) { STATE(archive, remaining_ms_); }
void Gains::visit(StateArchive& archive) { STATE(archive, pgain, feedfw, integt, derivt); }
void Actions::visit(StateArchive& archive) {
  STATE(archive, feed_forward, proportional, integral, derivative);
}
void Regulator::visit(StateArchive& archive) { STATE(archive, integral_, last_error_); }

void AxisSettings::visit(StateArchive& archive) {
  STATE(archive, resolution, bits_per_speed, max_speed, ramps, finish_ramp, gains, offset, reversal_pause_ms,
        max_following_error, frequency_window_ms);
}
void AnalogueAxis::visit(StateArchive& archive) {
  STATE(archive, settings, quota, transducer_, profile_, regulator_, frequency_, hold_, theoretical_, speed_,
        actions_, output_, drive_, counted_, target_, placed_, placing_, last_backward_, rest_ms_, pause_ms_,
        following_error_, frequency_new_);
}

void PresetSettings::visit(StateArchive& archive) {
  STATE(archive, mode, backward, quota, fast, slow, locked);
}
void PresetSearch::visit(StateArchive& archive) {
  STATE(archive, leg_, after_turn_, backward_, last_enable_);
}

}  // namespace drycut::devices::axis
