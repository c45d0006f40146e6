#pragma once
#include "devices/lx3vp/ecamtbx_registers.hpp"
#include "devices/lx3vp/il_program.hpp"
#include "devices/lx3vp/instructions.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp::il {

/// Whether a comparison of the contact kind (LD=, ANDD>) holds.
bool compare(const Registers& registers, const Step& step);
/// Executes an instruction on words or floating-point numbers. Throws RuntimeError.
void apply(Registers& registers, const Step& step);
/// Executes ECAMTBX: table and result, and what K0 and K1 report in their list. Throws RuntimeError.
EcamtbxReport apply_ecamtbx(Registers& registers, const Step& step);
/// What an instruction costs beyond that of any other, for the watchdog: words and bits that it handles.
std::int64_t work_of(const Registers& registers, const Step& step);
/// Hands DECAM or a pulse instruction to the controller, with the power into it. Throws
/// RuntimeError.
void drive_outputs(const Registers& registers, const Step& step, bool powered, Instructions& instructions);

}  // namespace drycut::devices::lx3vp::il
