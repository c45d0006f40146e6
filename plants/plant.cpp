#include "plants/plant.hpp"

#include <cassert>

#include "base/state_archive.hpp"

namespace drycut::plants {

void EncoderPort::visit(StateArchive& archive) { STATE(archive, count, before, now); }
void SignalPort::Edge::visit(StateArchive& archive) { STATE(archive, rising, fraction, width); }
void SignalPort::visit(StateArchive& archive) { STATE(archive, level, edges); }
void CommandPort::visit(StateArchive& archive) { STATE(archive, level); }
void ReferencePort::visit(StateArchive& archive) { STATE(archive, volts); }
void PulsePort::visit(StateArchive& archive) { STATE(archive, pulses); }

void Plant::visit_all(StateArchive& archive) {
  assert(archive.restores() || !has_events());
  if (!live_) live_ = live_parameters();
  for (const Parameter& row : *live_)
    std::visit([&](auto* value) { archive.named(row.name, *value); }, row.value);
  visit(archive);
  if (!archive.restores()) return;
  parameters_changed();
  events_.clear();
}

}  // namespace drycut::plants
