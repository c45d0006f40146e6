#include "plants/exact_sum.hpp"

#include "base/state_archive.hpp"

namespace drycut::plants {

void ExactSum::visit(StateArchive& archive) { STATE(archive, high_, low_); }

}  // namespace drycut::plants
