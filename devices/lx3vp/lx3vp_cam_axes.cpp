// The cams of an LX3VP as a simulation compares them with their laws.
#include <fmt/format.h>

#include <algorithm>

#include "devices/lx3vp/ecamtbx_registers.hpp"
#include "devices/lx3vp/lx3vp_controller.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

namespace {

constexpr std::size_t block_operand = 1;
constexpr std::size_t output_operand = 3;

/// The rows that a block holds; none if their number makes no sense.
std::vector<CamTableRow> sound_rows(const Registers& registers, int block) {
  const int count = registers.d[static_cast<std::size_t>(block + word::rows)];
  if (count < min_rows || count > max_rows || block + word::table + row_words * count > last_block_word + 1)
    return {};
  return read_rows(registers, block);
}

}  // namespace

std::vector<CamAxis> Lx3vpController::cam_axes() {
  std::vector<CamAxis> axes;
  for (const il::Step& step : program_.steps) {
    if (step.op() != il::Op::decam) continue;
    const int output = step.operands[output_operand].number;
    CamAxis axis;
    axis.name = fmt::format("Y{:o} (DECAM D{})", output, step.operands[block_operand].number);
    axis.pulses = Address{devices::Kind::output, 0, output};
    axis.start = [this, &step] {
      const Decam* cam = pulses_.cam(step.number);
      return cam == nullptr ? 0 : cam->starts();
    };
    axis.moment = [this, &step, output] {
      const Decam* cam = pulses_.cam(step.number);
      return cam == nullptr || output >= pulse_outputs ? CamMoment{} : cam->moment(pulses_.output(output));
    };
    axis.table = [this, &step] { return cam_table_of(step); };
    axes.push_back(std::move(axis));
  }
  return axes;
}

void Lx3vpController::keep_recipe(int number) {
  const il::Step* step = step_at(number);
  if (step == nullptr) return;
  const int list = step->operands[0].number;
  const il::Operand& type = step->operands[1];
  Recipe& recipe = recipes_[step->operands[2].number];
  recipe.type = static_cast<EcamType>(type.kind == il::OperandType::constant ? type.value
                                                                             : registers_.i16(type.number));
  recipe.saw = read_saw_parameters(registers_, list);
  recipe.s_curve = read_s_curve_parameters(registers_, list);
}

std::shared_ptr<const devices::CamTable> Lx3vpController::cam_table_of(const il::Step& step) const {
  const int block = step.operands[block_operand].number;
  if (block + block_length - 1 > last_block_word) return nullptr;
  const Decam* cam = pulses_.cam(step.number);
  const bool started = cam != nullptr && cam->starts() > 0;
  const auto rows = started ? cam->law().rows() : sound_rows(registers_, block);
  if (rows.empty()) return nullptr;
  EcamTable table;
  // The parameters behind the rows, if an ECAMTBX made just these.
  if (const auto found = recipes_.find(block); found != recipes_.end()) {
    table.type = found->second.type;
    table.saw = found->second.saw;
    table.s_curve = found->second.s_curve;
  }
  if (!table.is_made() || make_table(*table.type, table.saw, table.s_curve).rows != rows) table = {};
  table.rows = rows;
  const std::int32_t most = registers_.i32(block + word::max_frequency);
  if (most > 0 && most <= max_frequency_hz) table.max_frequency = most;
  const il::Operand& master = step.operands[0];
  if (master.kind == il::OperandType::constant) table.time_axis = master.value;
  table.cyclic = started ? cam->cyclic() : registers_.d[static_cast<std::size_t>(block + word::start)] == 1;
  return std::make_shared<const devices::CamTable>(std::move(table));
}

}  // namespace drycut::devices::lx3vp
