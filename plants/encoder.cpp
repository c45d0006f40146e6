#include "base/problem.hpp"
#include "base/state_archive.hpp"
#include "plants/transducers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/units.hpp"

namespace drycut::plants {

namespace {

constexpr double most_false_counts = 100000;  // of one burst

}  // namespace

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

void PulseLine::burst(double counts, bool by_chance) {
  const auto number = static_cast<std::size_t>(std::abs(counts));
  burst_.reserve(burst_.size() + number);
  for (std::size_t n = 0; n < number; ++n) {
    const double time = clock_ + burst_time_ * random_.uniform();
    const bool forward = by_chance ? random_.uniform() < 0.5 : counts > 0;
    burst_.push_back({time, forward ? 1.0 : -1.0});
  }
  std::sort(burst_.begin(), burst_.end(),
            [](const FalseCount& a, const FalseCount& b) { return a.time > b.time; });
  listen();
}

double PulseLine::false_counts(double h) {
  if (burst_.empty()) return 0;
  clock_ += h;
  double sum = 0;
  while (!burst_.empty() && burst_.back().time <= clock_) {
    sum += burst_.back().count;
    burst_.pop_back();
  }
  listen();
  return sum;
}

void PulseLine::offer_faults(std::vector<Fault>& faults, const std::string& component) {
  faults.push_back({component,
                    "lose_counts",
                    "",
                    [this](double v) { lose(v); },
                    "this many counts (x4) are lost at once: the count stays behind the motion",
                    in_counts,
                    {},
                    2000});
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
  faults.push_back({component,
                    "jitter",
                    "",
                    [this](double v) {
                      jitter_ = v;
                      listen();
                    },
                    "noise of the edges, rms counts (x4)",
                    {0, 1e6, false},
                    {},
                    200});
  faults.push_back({component,
                    "burst",
                    "",
                    [this](double v) { burst(v, true); },
                    "interference: this many false counts (x4) over burst_time, each forward or backward by "
                    "chance",
                    {0, most_false_counts, true},
                    {},
                    100'000});
  faults.push_back({component,
                    "add_counts",
                    "",
                    [this](double v) { burst(v, false); },
                    "this many false counts (x4) over burst_time, all forward or, below 0, all backward",
                    {-most_false_counts, most_false_counts, true},
                    {},
                    2000});
  faults.push_back(fault_value(component, "burst_time", "ms", burst_time_,
                               "how long the next burst lasts; 10 ms at first", {0, 60000, false}, 0));
}

void PulseLine::FalseCount::visit(StateArchive& archive) { STATE(archive, time, count); }

void PulseLine::visit(StateArchive& archive) {
  STATE(archive, port, random_, gain_, anchor_, base_, last_, forward_, stuck_, reverse_, jitter_,
        jitter_now_, noisy_, burst_time_, clock_, burst_);
}

void put_passed_index(SignalPort& index, double turns_before, double turns, double count_before, double count,
                      double count_per_turn, double width) {
  const double direction = turns > turns_before ? 1 : -1;
  const double last = direction * std::floor(direction * turns);
  const double passed = std::max(0.0, std::ceil(direction * (last - turns_before)));
  for (auto more = static_cast<std::int64_t>(passed) - 1; more >= 0; --more) {
    const double whole = last - direction * static_cast<double>(more);
    const double count_at_index = count + (whole - turns) * count_per_turn;
    // Far from zero `count` is rounded; the index is at a whole count if the start was.
    const double rounded = std::nearbyint(count_at_index);
    const double exact = std::abs(rounded - count_at_index) < 1e-4 ? rounded : count_at_index;
    const double fraction = std::clamp((exact - count_before) / (count - count_before), 0.0, 1.0);
    index.add_edge(true, fraction, width / std::abs(count - count_before));
    index.add_edge(false, fraction);
  }
}

Encoder::Encoder(const EncoderData& data, double start, Random noise)
    : pulses(noise),
      data_(data),
      uneven_(data.eccentricity != 0 || data.interpolation_error != 0 || data.tooth_error != 0),
      bits_per_turn_((data.reverse ? -4.0 : 4.0) * data.lines),
      start_(start + error(start - std::floor(start))) {}

// A disc whose middle lies e beside the axis, read at the radius R, shows e/R sin(angle) more than it turned.
double Encoder::error(double part) const {
  if (!uneven_) return 0;
  const double teeth =
      data_.tooth_error == 0 ? 0 : data_.tooth_error * std::sin(units::turn * part * data_.teeth);
  const double ahead = (data_.eccentricity * std::sin(units::turn * part) + teeth) / units::turn;
  if (data_.interpolation_error == 0) return ahead;
  const int periods = data_.signal_periods > 0 ? data_.signal_periods : data_.lines;
  return ahead + data_.interpolation_error / periods * std::sin(units::turn * part * periods);
}

void Encoder::sense(const Shaft& shaft, double h) {
  double from = shaft.revolutions_before();
  double to = shaft.revolutions();
  // The errors are 0 at whole turns: the index stays where it is.
  if (uneven_) {
    const auto of = [this](double part) { return error(part); };
    from += error_.at(shaft.part_before, of);
    to += error_.at(shaft.part, of);
  }
  const double before = (from - start_) * bits_per_turn_;
  const double now = (to - start_) * bits_per_turn_;
  pulses.carry(before, now, h);
  index.edges.clear();
  if (!pulses.stuck()) put_index(index, from, to, before, now, bits_per_turn_, data_.index_width);
}

void Encoder::visit(StateArchive& archive) { STATE(archive, pulses, index); }

const std::vector<Preset>& encoder_classes() {
  constexpr std::string_view once_a_turn = "encoder.eccentricity";
  constexpr std::string_view in_a_period = "encoder.interpolation_error";
  constexpr std::string_view even = "no error: a real one has some";
  constexpr double second = units::turn / 360 / 3600;  // of arc
  constexpr double minute = 60 * second;
  static const std::vector<Preset> all = {
      {"ideal", "encoder without errors", {{once_a_turn, 0, even}, {in_a_period, 0, even}}},
      {"ttl",
       "optical, its square waves are counted",
       {{once_a_turn, 40 * second, "estimate: as sin_cos, the disc is alike"},
        {in_a_period, 0.03,
         "Heidenhain, Position Encoders for Servo Drives, p. 29: 19\" at 2048 lines, 76\" at 512"}}},
      {"sin_cos",
       "optical, its sine waves are interpolated",
       {{once_a_turn, 40 * second, "Siemens, 1FK7 configuration manual 12.2006, p. 75: 40\" at 2048 periods"},
        {in_a_period, 0.01,
         "Heidenhain, Position Encoders for Servo Drives, p. 29: 6.5\" at 2048 lines, 25\" at 512"}}},
      {"resolver",
       "resolver of two poles, from which the amplifier makes the counts",
       {{once_a_turn, 14 * minute, "Siemens, 1FK7 configuration manual 12.2006, p. 77: less than 14'"},
        {in_a_period, 0, "its signal period is the turn"}}},
  };
  return all;
}

Parameters encoder_error_parameters(EncoderData& data) {
  return {
      preset_row("class", "kind of encoder, whose eccentricity and interpolation_error are the defaults",
                 data.encoder_class, encoder_classes(), "none is named: no errors"),
      row("eccentricity", "deg", "peak of its error once a turn: its disc sits off the axis",
          data.eccentricity, 0, 5, "encoder.class"),
      row("interpolation_error", "%", "peak of its error once a signal period, of that period",
          data.interpolation_error, 0, 10, "encoder.class"),
      row("signal_periods", "signal periods of its disc a turn, 0 = as many as lines", data.signal_periods, 0,
          1000000, "its lines are those of the disc"),
      row("tooth_error", "deg", "peak of its error once a tooth of its gear or coupling", data.tooth_error, 0,
          5, "ideal: none"),
      row("teeth", "teeth, for tooth_error", data.teeth, 1, 100000, "a round number"),
      row("index_width", "", "counts (x4) that its index pulse lasts; a card may ask for a least time",
          data.index_width, 0.01, 1e6, "usual: gated with both channels"),
  };
}

std::vector<PlantDefinition::Objection> encoder_objections(const EncoderData& data) {
  const double others = data.eccentricity + units::turn * data.interpolation_error;
  if (others + data.tooth_error * data.teeth < 1) return {};
  return {{"plant.parameters-contradict"_code, "encoder.tooth_error",
           fmt::format("with {} teeth the count would go back within each", data.teeth),
           fmt::format("less than {:.3g} deg, or fewer teeth", (1 - others) / data.teeth * units::degrees)}};
}

}  // namespace drycut::plants
