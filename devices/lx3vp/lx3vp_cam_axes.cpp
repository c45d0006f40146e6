// The cams of an LX3VP as a simulation compares them with their laws.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "devices/lx3vp/block.hpp"
#include "devices/lx3vp/ecamtbx_registers.hpp"
#include "devices/lx3vp/lx3vp_controller.hpp"

namespace drycut::devices::lx3vp {

namespace {

constexpr std::size_t block_operand = 1;
constexpr std::size_t output_operand = 3;

EcamResult made_of(EcamType type, const SawParameters& saw, const SCurveParameters& s_curve) {
  if (type == EcamType::rotary_saw) return make_rotary_saw(saw);
  return type == EcamType::fly_saw ? make_fly_saw(saw) : make_s_curve(type, s_curve);
}

/// The rows that a block holds; none if their number makes no sense.
std::vector<CamTableRow> rows_of(const Registers& registers, int block) {
  const int count = registers.d[static_cast<std::size_t>(block + word::rows)];
  if (count < min_rows || count > max_rows || block + word::table + row_words * count > last_block_word + 1)
    return {};
  std::vector<CamTableRow> rows;
  for (int row = 0; row < count; ++row) {
    const int at = block + word::table + row_words * row;
    rows.push_back({registers.i32(at), registers.i32(at + 2)});
  }
  return rows;
}

}  // namespace

std::vector<CamAxis> Lx3vpController::cam_axes() {
  std::vector<CamAxis> axes;
  for (const il::Step& step : program_.steps) {
    if (step.op() != il::Op::decam) continue;
    const int output = step.operands[output_operand].number;
    CamAxis axis;
    axis.name = fmt::format("Y{:o} (DECAM D{})", output, step.operands[block_operand].number);
    axis.kind = "lx3vp";
    axis.pulses = Address{devices::Kind::output, 0, output};
    axis.start = [this, &step] {
      const Decam* cam = pulses_.cam(step.number);
      return cam == nullptr ? 0 : cam->starts();
    };
    axis.moment = [this, &step, output] {
      const Decam* cam = pulses_.cam(step.number);
      return cam == nullptr || output >= pulse_outputs ? CamMoment{} : cam->moment(pulses_.output(output));
    };
    axis.table = [this, &step] { return cam_table_text(step); };
    axes.push_back(std::move(axis));
  }
  return axes;
}

void Lx3vpController::keep_recipe(int number) {
  const auto step = std::find_if(program_.steps.begin(), program_.steps.end(),
                                 [&](const il::Step& candidate) { return candidate.number == number; });
  if (step == program_.steps.end()) return;
  const int list = step->operands[0].number;
  const il::Operand& type = step->operands[1];
  const int wanted = type.kind == il::Kind::constant ? type.value : registers_.i16(type.number);
  recipes_[step->operands[2].number] = {static_cast<EcamType>(wanted), read_saw_parameters(registers_, list),
                                        read_s_curve_parameters(registers_, list)};
}

/// The parameters behind the rows, if an ECAMTBX made just these; else "".
std::string Lx3vpController::recipe_text(int block, const std::vector<CamTableRow>& rows) const {
  const auto found = recipes_.find(block);
  if (found == recipes_.end()) return "";
  const auto& [type, saw, curve] = found->second;
  if (made_of(type, saw, curve).rows != rows) return "";
  const auto head = fmt::format("# ecamtbx: K{}\nparameter,value\n", static_cast<int>(type));
  if (type == EcamType::s_curve_0 || type == EcamType::s_curve_1)
    return head + fmt::format("P1,{}\nP2,{}\nP4,{}\nP5,{}\nP6,{}\n", curve.length, curve.top_speed,
                              curve.acceleration, curve.deceleration, curve.resolution);
  return head + fmt::format("P1,{}\nP2,{}\nP3,{}\nP4,{}\nP5,{}\nP6L,{}\nP6H,{}\nP7,{}\n", saw.master_length,
                            saw.slave_length, saw.sync_length, saw.sync_ratio, saw.max_ratio,
                            saw.acceleration, saw.curve, saw.resolution);
}

std::string Lx3vpController::cam_table_text(const il::Step& step) const {
  const int block = step.operands[block_operand].number;
  if (block + block_length - 1 > last_block_word) return "";
  const Decam* cam = pulses_.cam(step.number);
  const bool started = cam != nullptr && cam->starts() > 0;
  const auto rows = started ? cam->law().rows() : rows_of(registers_, block);
  if (rows.empty()) return "";
  std::string text;
  const std::int32_t most = registers_.i32(block + word::max_frequency);
  if (most > 0 && most <= max_frequency_hz) text += fmt::format("# max_frequency: {}\n", most);
  const il::Operand& master = step.operands[0];
  if (master.kind == il::Kind::constant) text += fmt::format("# time_axis: {}\n", master.value);
  const bool cyclic =
      started ? cam->cyclic() : registers_.d[static_cast<std::size_t>(block + word::start)] == 1;
  text += fmt::format("# cyclic: {}\n", cyclic ? 1 : 0);
  if (const auto recipe = recipe_text(block, rows); !recipe.empty()) return text + recipe;
  text += "master,slave\n";
  for (const CamTableRow& row : rows)
    fmt::format_to(std::back_inserter(text), "{},{}\n", row.master, row.slave);
  return text;
}

}  // namespace drycut::devices::lx3vp
