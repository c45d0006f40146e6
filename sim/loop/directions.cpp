#include "sim/loop/directions.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "base/state_archive.hpp"
#include "sim/loop/wires.hpp"
#include "sim/record/recording.hpp"

namespace drycut::sim::loop {

namespace {

constexpr Time watched_time = 1 * second;     // of being driven, is looked at
constexpr double idle_volts = 0.02;           // [V] and below: an offset
constexpr std::int64_t counts_enough = 1000;  // counts that no play and no rebound makes
constexpr std::int64_t clearly = 4;           // times as far the wrong way

// A drive turns at such references; an axis that stands there for so long stands against an offset.
constexpr double least_offset = 0.1;       // [V]
constexpr double most_offset = 2;          // [V]
constexpr Time long_enough = 1 * second;   // at ...
constexpr double steady_volts = 0.02;      // [V] ... this much less or more ...
constexpr std::int64_t steady_counts = 8;  // ... and within so many counts

std::string swapped_wire(const scenario::Scenario& scenario, devices::Controller& controller,
                         const devices::Controller::PositionLoop& loop) {
  if (!loop.forward) return "";
  const auto* wire = wire_at(scenario, controller, *loop.forward);
  if (wire == nullptr || !wire->plug.text.ends_with(".backward")) return "";
  return fmt::format("its forward output {} is wired to {}", wire->terminal.text, wire->plug.text);
}

}  // namespace

Directions::Directions(const scenario::Scenario& scenario, devices::Controller& controller) {
  for (auto& loop : controller.position_loops()) {
    auto swapped = swapped_wire(scenario, controller, loop);
    const auto counts = loop.counts();
    axes_.push_back({std::move(loop), std::move(swapped), counts});
  }
}

void Directions::sample(Time now) {
  for (auto& axis : axes_) {
    if (axis.done && axis.told) continue;
    const double drive = axis.loop.drive();
    const auto counts = axis.loop.counts();
    look_at_standing(axis, drive, counts, now);
    if (axis.done) continue;
    const auto gone = counts - axis.counts;
    axis.counts = counts;
    if (std::abs(drive) > idle_volts) {
      if (!axis.begun) axis.begun = now;
      ((drive > 0) == (gone > 0) ? axis.with : axis.against) += std::abs(gone);
    }
    const bool wrong = axis.against >= counts_enough && axis.against > clearly * axis.with;
    if (wrong) tell(axis, now);
    axis.done = wrong || (axis.begun && now - *axis.begun >= watched_time);
  }
}

void Directions::look_at_standing(Axis& axis, double drive, std::int64_t counts, Time now) {
  const bool steady =
      std::abs(drive - axis.volts) <= steady_volts && std::abs(counts - axis.place) <= steady_counts;
  if (!steady) {
    axis.stood = now;
    axis.volts = drive;
    axis.place = counts;
  }
  const double volts = std::abs(axis.volts);
  if (axis.loop.forward || axis.told || volts < least_offset || volts > most_offset ||
      now - axis.stood < long_enough)
    return;
  axis.told = true;
  found_.push_back({seconds(axis.stood),
                    {"loop.axis-stands"_code,
                     fmt::format("{} stands from {} s on though its reference is {:.2g} V: its drive has an "
                                 "offset or a dead band",
                                 axis.loop.name, record::seconds_text(axis.stood), axis.volts)}});
}

void Directions::tell(const Axis& axis, Time now) {
  const auto& loop = axis.loop;
  auto text = fmt::format("{} went {} counts against its drive from {} s to {} s: ", loop.name, axis.against,
                          record::seconds_text(*axis.begun), record::seconds_text(now));
  text += !axis.swapped.empty() ? axis.swapped
          : loop.forward
              ? fmt::format(
                    "it counts the wrong way, forward and backward are swapped ({}), or its load drives it",
                    loop.remedy)
              : fmt::format("positive feedback, it counts or turns the wrong way ({})", loop.remedy);
  found_.push_back({seconds(*axis.begun), {"loop.axis-astray"_code, std::move(text)}});
}

void Directions::visit(StateArchive& archive) {
  archive.each("axes_", axes_, [&](Axis& axis) {
    STATE(archive, axis.counts, axis.begun, axis.with, axis.against, axis.done, axis.stood, axis.volts,
          axis.place, axis.told);
  });
  archive.list("found_", found_, [&](Found& found) { STATE(archive, found.at, found.what); });
}

}  // namespace drycut::sim::loop
