#pragma once
#include "plants/random.hpp"

namespace drycut::sim::loop {

/// Noise of the frequencies from `low` to `high` [Hz], rms 1, a value every `step` seconds: white noise
/// through a filter of second order, 3 dB down at its ends. From 0 it is Butterworth's low-pass, else a
/// band-pass, by the bilinear transform with both ends at their place. high < 1 / (2 step).
///
/// It starts at 0 and has its rms after some 1 / (high - low).
class BandNoise {
 public:
  BandNoise(double low, double high, double step, plants::Random random);
  double next();
  void visit(StateArchive& archive);

 private:
  plants::Random random_;
  bool low_pass_;
  double g_;     // tangent of half the turn a step of the middle of the band
  double k_;     // damping: 1 / Q
  double d_;     // 1 + g (g + k)
  double gain_;  // to rms 1
  double first_ = 0;
  double second_ = 0;
};

}  // namespace drycut::sim::loop
