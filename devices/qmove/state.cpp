// What of a QMOVE is state.
#include <span>

#include "base/state_archive.hpp"
#include "devices/qmove/qmove_controller.hpp"

namespace drycut::devices::qmove {

void QmoveController::visit(StateArchive& archive) {
  STATE(archive, cards_);
  visit_machine(archive);
  for (std::size_t i = 0; i < programs_.size(); ++i) archive.named(programs_[i].name, tasks_[i]);
  for (std::size_t i = 0; i < device_due_.size(); ++i)
    archive.named(configuration_.devices[i].name + ".TCamp", device_due_[i]);
  STATE(archive, powered_, mode_, error_, failed_, round_, computed_ns_, place_, in_round_, next_device_ns_,
        events_);
  std::vector<Said> said(said_.begin(), said_.end());
  STATE(archive, said);
  if (archive.restores()) said_ = {said.begin(), said.end()};
}

void QmoveController::Said::visit(StateArchive& archive) { STATE(archive, device, kind, subject, text); }

// Under the names of the configuration.
void QmoveController::visit_machine(StateArchive& archive) {
  for (const NamedThing& thing : names_.things()) {
    const auto index = static_cast<std::size_t>(thing.index);
    switch (thing.kind) {
      case NamedThing::Kind::scalar:
      case NamedThing::Kind::array:
      case NamedThing::Kind::group_static:
      case NamedThing::Kind::group_step:
        visit_values(archive, thing.name,
                     std::span(machine_.cells).subspan(index, static_cast<std::size_t>(cell_count(thing))));
        break;
      case NamedThing::Kind::timer:
        archive.named(thing.name, machine_.timers[index]);
        break;
      case NamedThing::Kind::device:
        archive.named(thing.name, *machine_.devices[index]);
        archive.named(thing.name + ".oldest_post", machine_.oldest_post[index]);
        break;
      case NamedThing::Kind::constant:
      case NamedThing::Kind::group:
      case NamedThing::Kind::input:
      case NamedThing::Kind::output:
        break;
    }
  }
  archive.named("now", machine_.now);
  archive.named("posts", machine_.posts);
}

}  // namespace drycut::devices::qmove
