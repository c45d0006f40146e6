#include "plants/end_stop.hpp"

#include "base/state_archive.hpp"

namespace drycut::plants {

void EndStop::visit(StateArchive& archive) {
  STATE(archive, force_, touched_, compressing_, hit_speed_, impulse_, peak_, fraction_, h_);
}

}  // namespace drycut::plants
