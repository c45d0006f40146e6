#include "plants/encoder.hpp"

#include <algorithm>

namespace drycut::plants {

void PulseLine::change_gain() {
  base_ += gain_ * (last_ - anchor_);
  anchor_ = last_;
  gain_ = stuck_ ? 0 : (reverse_ ? -1 : 1);
}

void PulseLine::lose(double counts) {
  // Lost pulses leave the count behind, in the direction in which it was counting.
  if (stuck_) return;
  // Again and again they do not leave what a counter holds.
  constexpr double most = 1e18;
  base_ = std::clamp(base_ - (forward_ != reverse_ ? counts : -counts), -most, most);
}

void PulseLine::offer_faults(std::vector<Fault>& faults, const std::string& component) {
  faults.push_back({component, "lose_counts", "", [this](double v) { lose(v); },
                    "this many counts (x4) are lost at once: the count stays behind the motion", in_counts});
  faults.push_back({component, "stuck", "",
                    [this](double v) {
                      stuck_ = v != 0;
                      change_gain();
                    },
                    "1: no more pulses; 0: counting goes on from there"});
  faults.push_back({component, "reverse", "",
                    [this](double v) {
                      reverse_ = v != 0;
                      change_gain();
                    },
                    "1: the channels are exchanged, it counts the other way from now on"});
  faults.push_back(
      fault_value(component, "jitter", "", jitter_, "noise of the edges, rms counts (x4)", {0, 1e6, false}));
}

void put_index(SignalPort& index, double turns_before, double turns, double count_before, double count,
               double count_per_turn) {
  const double direction = turns > turns_before ? 1 : -1;
  const double last = direction * std::floor(direction * turns);
  const double passed = std::max(0.0, std::ceil(direction * (last - turns_before)));
  for (double more = passed - 1; more >= 0; --more) {
    const double whole = last - direction * more;
    const double count_at_index = count + (whole - turns) * count_per_turn;
    // Far from zero `count` is rounded; the index is at a whole count if the start was.
    const double rounded = std::nearbyint(count_at_index);
    const double exact = std::abs(rounded - count_at_index) < 1e-4 ? rounded : count_at_index;
    const double fraction = std::clamp((exact - count_before) / (count - count_before), 0.0, 1.0);
    index.add_edge(true, fraction);
    index.add_edge(false, fraction);
  }
}

Encoder::Encoder(const EncoderData& data, double start, Random noise)
    : pulses(noise), bits_per_turn_((data.reverse ? -4.0 : 4.0) * data.lines), start_(start) {}

void Encoder::sense(const Shaft& shaft) {
  const double before = (shaft.revolutions_before() - start_) * bits_per_turn_;
  const double now = (shaft.revolutions() - start_) * bits_per_turn_;
  pulses.carry(before, now);
  index.edges.clear();
  if (!pulses.stuck())
    put_index(index, shaft.revolutions_before(), shaft.revolutions(), before, now, bits_per_turn_);
}

}  // namespace drycut::plants
