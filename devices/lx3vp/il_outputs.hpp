#pragma once
#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/instructions.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp::il {

/// Hands DECAM or a pulse instruction to the controller, with the power into it. Throws
/// RuntimeError.
void drive_outputs(const Registers& registers, const Step& step, bool powered, Instructions& instructions);

}  // namespace drycut::devices::lx3vp::il
