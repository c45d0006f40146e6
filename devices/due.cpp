#include "devices/due.hpp"

#include "base/state_archive.hpp"

namespace drycut::devices {

void Due::visit(StateArchive& archive) { STATE(archive, next_ns); }

}  // namespace drycut::devices
