#include "plants/delayed_contact.hpp"

#include "base/state_archive.hpp"

namespace drycut::plants {

void DelayedContact::visit(StateArchive& archive) {
  STATE(archive, command_, follows_, remaining_, stuck_on_, stuck_off_);
}

}  // namespace drycut::plants
