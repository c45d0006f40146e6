#include "sim/loop/strobe.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/scenario/format.hpp"

namespace drycut::sim::loop {

namespace {

constexpr double ambiguous = 0.5;  // pitches from frame to frame
constexpr double clear = 0.25;

/// 1, 2, 5 times a power of ten nanoseconds, and a whole multiple of `unit`; 0 if that is less than one.
Time round_down(double period, Time unit) {
  Time decade = 1;
  while (static_cast<double>(decade) * 10 <= period) decade *= 10;
  Time round = decade;
  for (const Time factor : {2, 5})
    if (static_cast<double>(factor * decade) <= period) round = factor * decade;
  return round / unit * unit;
}

}  // namespace

std::vector<std::optional<Strobe>> strobes(const std::vector<PartWithPitch>& parts,
                                           const std::vector<Snapshot>& frames) {
  std::vector<std::optional<Strobe>> found(frames.size());
  for (std::size_t f = 1; f < frames.size(); ++f) {
    double most = ambiguous;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double pitches = frames[f].turned.at(i) / parts[i].pitch;
      if (pitches <= most) continue;
      most = pitches;
      found[f] = {parts[i].name, pitches};
    }
  }
  return found;
}

std::optional<Strobe> worst_strobe(const std::vector<std::optional<Strobe>>& frames) {
  std::optional<Strobe> worst;
  for (const auto& one : frames)
    if (one && (!worst || one->pitches > worst->pitches)) worst = one;
  return worst;
}

std::string text_of(const Strobe& strobe, const scenario::PicturesSection& pictures, Time step) {
  const Time every =
      round_down(static_cast<double>(pictures.every) * clear / strobe.pitches, step * pictures.slow);
  return fmt::format(
      "stroboscopic effect: {} turns by up to {:.1f} of its pitches from frame to frame, more than half of "
      "one "
      "looks slower, backwards or still; {}",
      strobe.part, strobe.pitches,
      every > 0 ? fmt::format("frames.every: {} shows how it turns", scenario::format_time(every))
                : "no frames.every of whole steps shows how it turns");
}

}  // namespace drycut::sim::loop
