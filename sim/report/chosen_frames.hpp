#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "sim/loop/simulation.hpp"

namespace drycut::sim::report {

/// Something worth a picture.
struct Moment {
  double time_s = 0;
  std::string what;      ///< "first cut"
  bool changes = false;  ///< something begins then: no picture from before shows it
};

/// What happened while a film was taken, the most telling first: the first cut, faults, where a check failed,
/// the worst cut, the end, cuts of another length than the one before, the first of every other event of a
/// plant.
std::vector<Moment> moments_of(const record::EventLog& events, const std::vector<record::CheckResult>& checks,
                               double begin_s, double end_s);
/// What a film about an event shows: the event, the film's beginning and end.
std::vector<Moment> moments_around(double event_s, double begin_s, double end_s);

struct ChosenFrame {
  std::size_t frame = 0;
  std::string what;  ///< of all moments that it shows: "first cut, worst cut"; "" = none
};

/// At most `wanted` of the frames at these times, in their order: those nearest to the first of the moments,
/// and others between them where most time is left. They begin with a moment, not with a machine at rest.
std::vector<ChosenFrame> chosen_frames(const std::vector<double>& times_s, const std::vector<Moment>& moments,
                                       std::size_t wanted);

/// The frame that stands for the film: of the most telling moment before the end, else in the middle.
std::size_t poster_frame(const std::vector<double>& times_s, const std::vector<Moment>& moments);

}  // namespace drycut::sim::report
