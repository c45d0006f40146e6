#include "sim/loop/wire_cuts.hpp"

#include "base/state_archive.hpp"

namespace drycut::sim::loop {

using devices::PulseTrain;
using plants::EncoderPort;
using plants::PulsePort;
using plants::SignalPort;

namespace {

/// What counts goes on behind its open end for ever: a counter knows nothing of what it has missed.
template <typename Port>
constexpr bool counts = std::is_same_v<Port, const EncoderPort> || std::is_same_v<Port, const PulseTrain> ||
                        std::is_same_v<Port, PulsePort>;

}  // namespace

/// Where the wire leads to now.
template <typename Port>
void WireCuts::lead(Wire<Port>& wire) {
  *wire.end = wire.touched && (counts<Port> || wire.cut) ? &wire.open : wire.plug;
}

template <typename Port>
void WireCuts::set(Wire<Port>& wire, bool cut) {
  if (cut == wire.cut) return;
  if constexpr (counts<Port>)
    if (!wire.touched) wire.open = *wire.plug;
  if constexpr (std::is_same_v<Port, const SignalPort>)
    if (cut && wire.plug->level) wire.open.add_edge(false, 0);
  if constexpr (std::is_same_v<Port, plants::CommandPort>) wire.plug->level = false;
  if constexpr (std::is_same_v<Port, plants::ReferencePort>) wire.plug->volts = 0;
  wire.touched = true;
  wire.cut = cut;
  lead(wire);
}

std::vector<std::pair<std::string, plants::Fault>> WireCuts::faults() {
  std::vector<std::pair<std::string, plants::Fault>> faults;
  for (auto& any : wires_)
    std::visit(
        [&](auto& wire) {
          const auto component = "wire." + wire.terminal;
          faults.emplace_back(component, plants::Fault{component, "cut", "",
                                                       [this, &wire](double on) {
                                                         set(wire, on != 0);
                                                         any_ = true;
                                                       },
                                                       "1: nothing comes through the wire any more"});
        },
        any);
  return faults;
}

void WireCuts::count() {
  for (auto& any : wires_) {
    if (auto* wire = std::get_if<Wire<const EncoderPort>>(&any); wire != nullptr && wire->touched) {
      auto& open = wire->open;
      if (wire->cut) {
        wire->behind = wire->plug->count - open.count;
        open.before = open.now = static_cast<double>(open.count);
      } else {
        open.count = wire->plug->count - wire->behind;
        open.before = wire->plug->before - static_cast<double>(wire->behind);
        open.now = wire->plug->now - static_cast<double>(wire->behind);
      }
    } else if (auto* loop = std::get_if<Wire<const PulseTrain>>(&any); loop != nullptr && loop->touched) {
      if (loop->cut)
        loop->behind = loop->plug->count - loop->open.count;
      else
        loop->open.count = loop->plug->count - loop->behind;
    } else if (auto* pulses = std::get_if<Wire<PulsePort>>(&any); pulses != nullptr && pulses->touched) {
      if (pulses->cut)
        pulses->behind = pulses->open.pulses - pulses->plug->pulses;
      else
        pulses->plug->pulses = pulses->open.pulses - pulses->behind;
    }
  }
}

void WireCuts::clear_edges() {
  for (auto& any : wires_)
    if (auto* wire = std::get_if<Wire<const SignalPort>>(&any)) wire->open.edges.clear();
}

void WireCuts::visit(StateArchive& archive) {
  STATE(archive, any_);
  if (!any_ && !archive.restores()) return;
  for (auto& any : wires_)
    std::visit(
        [&](auto& wire) {
          if (any_) {
            STATE(archive, wire.touched, wire.cut, wire.behind, wire.open);
          } else {
            wire.touched = wire.cut = false;
            wire.behind = 0;
            wire.open = {};
          }
          lead(wire);
        },
        any);
}

}  // namespace drycut::sim::loop
