#include <algorithm>

#include <fmt/format.h>

#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/machine.hpp"

// Calls.
namespace drycut::devices::plcopen::st {

Cell Machine::call_function(const Instruction& of, const Bases& bases) {
  const int* const list = code_.lists.data() + of.d;
  return call_framed(of, bases, list, list[0], bases[static_cast<std::size_t>(Base::own)] - memory_.data());
}

Cell Machine::call_method(const Instruction& of, const Bases& bases) {
  const int* const list = code_.lists.data() + of.d;
  const std::int64_t instance = at(bases, unpacked(list[0]));
  int number = list[2];
  if (list[1] >= 0)
    if (const auto actual = code_.methods.find({at(instance), list[1]}); actual != code_.methods.end())
      number = actual->second;
  active_.resize(code_.pous.size());
  const auto pou = static_cast<std::size_t>(number);
  if (active_[pou]) fail(of, fmt::format("{} calls itself; use a loop", code_.pous[pou].type->name));
  active_[pou] = true;
  const Cell result = call_framed(of, bases, list + 2, number, instance);
  active_[pou] = false;
  return result;
}

/// The arguments are for the POU that the list begins with. Where another one runs that overrides it, that
/// has the same pins at the same places.
Cell Machine::call_framed(const Instruction& of, const Bases& bases, const int* list, int number,
                          std::int64_t own) {
  const Pou& pou = code_.pous[static_cast<std::size_t>(number)];
  const Pou& named = code_.pous[static_cast<std::size_t>(*list++)];
  const int shift = pou.frame - named.frame;
  spend(of, pou.type->cells / 8);
  reset(pou, pou.frame);
  for (int inputs = *list++; inputs > 0; --inputs, list += 3) {
    const Cell given = at(bases, unpacked(list[0]));
    const int place = list[1] + shift;
    const int cells = list[2];
    if (cells == 1)
      at(place) = given;
    else if (cells > 1)
      copy_string(given, place, static_cast<std::size_t>(cells) - 2);
    else
      std::copy_n(memory_.begin() + given, -cells, memory_.begin() + place);
  }
  execute(pou.body, own);
  if (shift != 0)
    std::copy_n(memory_.begin() + pou.frame, std::min(pou.type->cells, named.type->cells),
                memory_.begin() + named.frame);
  const std::int64_t from = pou.frame + pou.result;
  if (of.c.cells == 0) return at(from);
  const Cell result = at(bases, of.b);
  std::copy_n(memory_.begin() + from, of.c.cells, memory_.begin() + result);
  return result;
}

void Machine::call_block(const Instruction& of, std::int64_t instance) {
  const Pou& pou = code_.pous[static_cast<std::size_t>(of.d)];
  spend(of, 0);
  reset(pou, instance);
  execute(pou.body, instance);
}

const FunctionBlock* Machine::motion_at(int place) const {
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const Compiled::Motion& motion = code_.motions[i];
    if (place >= motion.cell && place < motion.cell + motion.type->cells) return motions_[i].block.get();
  }
  return nullptr;
}

void Machine::call_motion(const Instruction& of, Cell* instance) {
  constexpr std::int64_t work_of_a_motion_block = 50;
  spend(of, work_of_a_motion_block);
  const Motion& motion = motions_[static_cast<std::size_t>(*instance)];
  // Most pins are of these types.
  for (const auto& [value, cell] : motion.inputs) {
    const Cell* const from = instance + cell;
    if (bool* const* const flag = std::get_if<bool*>(&value)) {
      **flag = *from != 0;
      continue;
    }
    if (double* const* const number = std::get_if<double*>(&value)) {
      **number = real_of(*from);
      continue;
    }
    std::visit(
        [&](auto* target) {
          using T = std::remove_cvref_t<decltype(*target)>;
          if constexpr (std::is_same_v<T, AxisRef>) {
            target->number = static_cast<int>(*from);
          } else if constexpr (std::is_same_v<T, CamRef>) {
            const std::string_view file = text(place_of(*from), default_string_length);
            if (target->file != file) target->file = file;
            target->id = static_cast<std::uint16_t>(from[string_cells(default_string_length)]);
          } else if constexpr (!std::is_same_v<T, double>) {
            *target = static_cast<T>(*from);
          }
        },
        value);
  }
  motion.block->call(kernel_);
  for (const auto& [value, cell] : motion.outputs) {
    if (bool* const* const flag = std::get_if<bool*>(&value))
      instance[cell] = **flag ? 1 : 0;
    else if (const auto shown = cell_of_pin(value))
      instance[cell] = *shown;
  }
}

}  // namespace drycut::devices::plcopen::st
