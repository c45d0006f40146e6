#include <algorithm>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "devices/plcopen/kernel.hpp"
#include "devices/plcopen/st/machine.hpp"

// Calls.
namespace drycut::devices::plcopen::st {

Cell Machine::call_function(const StInstruction& of, const Bases& bases) {
  const int* const list = code_.lists.data() + of.d;
  return call_framed(of, bases, list, list[0], bases[static_cast<std::size_t>(Base::own)] - memory_.data());
}

Cell Machine::call_method(const StInstruction& of, const Bases& bases) {
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
Cell Machine::call_framed(const StInstruction& of, const Bases& bases, const int* list, int number,
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
  if (pou.unfit >= 0 && at(pou.frame + pou.unfit) != 0) tell_unfit(of, pou);
  if (shift != 0)
    std::copy_n(memory_.begin() + pou.frame, std::min(pou.type->cells, named.type->cells),
                memory_.begin() + named.frame);
  const std::int64_t from = pou.frame + pou.result;
  if (of.c.cells == 0) return at(from);
  const Cell result = at(bases, of.b);
  std::copy_n(memory_.begin() + from, of.c.cells, memory_.begin() + result);
  return result;
}

void Machine::tell_unfit(const StInstruction& call, const Pou& function) {
  const auto told = [&](const Variable& variable) {
    const Basic basic = variable.type->basic;
    const Cell value = at(function.frame + variable.offset);
    return is_bits(basic) ? fmt::format("16#{:X}", static_cast<std::uint64_t>(value)) : text_of(basic, value);
  };
  std::vector<std::string> inputs;
  for (const Variable& member : function.type->members)
    if (member.section == VarClass::input) inputs.push_back(told(member));
  tell_loss(call, fmt::format("{}({}) does not fit, {} is made of it", function.type->name,
                              fmt::join(inputs, ", "), told(function.type->members.front())));
}

void Machine::call_block(const StInstruction& of, std::int64_t instance) {
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

void Machine::call_motion(const StInstruction& of, Cell* instance) {
  constexpr std::int64_t work_of_a_motion_block = 50;
  spend(of, work_of_a_motion_block);
  const Motion& motion = motions_[static_cast<std::size_t>(*instance)];
  const BlockType& type = *motion.type->motion;
  static_assert(std::is_same_v<Cell, PinCell> && cam_file_length == default_string_length);
  type.take_inputs(*motion.block, instance + 1);
  motion.block->call(kernel_);
  type.give_outputs(*motion.block, instance + 1);
}

}  // namespace drycut::devices::plcopen::st
