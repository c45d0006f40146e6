#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/loop/simulation.hpp"
#include "sim/studies/bode/response.hpp"

namespace drycut::sim::studies {

/// One frequency of a sweep: `cycles` whole periods in `samples` samplings of the controller.
struct TestTone {
  std::int64_t cycles = 0;
  std::int64_t samples = 0;
  [[nodiscard]] double frequency(Time sampling) const {  ///< [Hz]
    return static_cast<double>(cycles) / (static_cast<double>(samples) * seconds(sampling));
  }
};

/// About `points` frequencies from `from` to `to` [Hz], evenly on a logarithmic axis, each measured over at
/// least `window` seconds and four periods; `to` at most half the sampling frequency. Neighbours that would
/// be the same are one.
std::vector<TestTone> plan_tones(double from, double to, int points, Time sampling, double window);

/// What to measure and how.
struct SweepPlan {
  std::size_t wire = 0;  ///< of Bus::analogue_wires()
  std::string speed;     ///< channel of the motor's speed, "" = not measured
  Time at = 0;           ///< the scenario runs undisturbed until then
  Time step = 0;         ///< of the scenario
  Time sampling = 0;     ///< of the device that drives the wire
  double amplitude = 0;  ///< of the sine [V]
  double settle = 0;     ///< before each measurement [s], and at least two periods
  std::vector<TestTone> tones;
  double lowest = 0;  ///< [Hz] down to here lower tones follow until |L| > 1, so that the crossover is found;
                      ///< 0 = none
};

/// What came of it.
struct Sweep {
  enum class Loop : std::uint8_t {
    closed,    ///< it answers and comes to rest after a push
    open,      ///< the controller's output does not answer
    restless,  ///< after a push it neither came to rest nor swings evenly: longer or harder would tell
    runaway,   ///< after a push it goes to the limit and stays there
    unstable   ///< it swings on after a push, over several periods
  };
  Loop loop = Loop::closed;
  double waited = 0;              ///< for rest after the push [s]
  std::vector<BodePoint> points;  ///< none unless the loop is closed
  double faded_from = 0;          ///< [Hz] from here on the answer is finer than the resolution; 0 = nowhere
  std::string failure;            ///< why the simulation itself stopped, "" if it did not
};

/// Measures the loop through an analogue wire: a sine is added between controller and drive, held over the
/// controller's sampling as its own output is, one frequency after the other while the loop stays closed.
/// `excited` and `still` are the same scenario twice: what they differ by is what the sine does, so that a
/// machine in motion can be measured. Open loop L = -output / total at the wire, at the sampling instants:
/// the loop that the controller closes, sampling and hold included.
Sweep measure(loop::Simulation& excited, loop::Simulation& still, const SweepPlan& plan,
              const std::function<void(double)>& progress = {});

}  // namespace drycut::sim::studies
