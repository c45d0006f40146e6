#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"

// Where everything is in the memory: VAR_GLOBAL, the PROGRAM, the FUNCTIONs, literals; and the symbols.
namespace drycut::devices::plcopen::st {

void Compiler::place_memory() {
  int next = globals_->cells;
  for (const auto& unit : units_) {
    if (unit->pou < 0 || unit->kind == Unit::Kind::function_block) continue;
    Pou& pou = code_->pous[static_cast<std::size_t>(unit->pou)];
    pou.frame = next;
    next += unit->type->cells;
    if (unit->pou == code_->program) program_at_ = pou.frame;
  }
  memory_ = next;
}

void Compiler::finish() {
  Compiled& code = *code_;
  for (std::size_t i = 0; i < code.located_cells.size(); ++i)
    code.located_cells[i] += located_in_globals_[i] ? 0 : program_at_;
  for (Node& node : code.nodes) {
    if (node.op != Op::address_pool) continue;
    node.op = Op::address;
    node.imm += memory_;
  }
  code.image.assign(static_cast<std::size_t>(memory_), 0);
  if (problems_.size() != first_problem_) {
    // Not to be run; who does finds a memory and nothing to do.
    code.program = -1;
    return;
  }
  const auto fill = [&](const Type& type, int at) {
    std::copy(type.initial.begin(), type.initial.end(), code.image.begin() + at);
  };
  fill(*globals_, 0);
  for (const auto& unit : units_)
    if (unit->pou >= 0 && unit->kind != Unit::Kind::function_block)
      fill(*unit->type, code.pous[static_cast<std::size_t>(unit->pou)].frame);
  code.image.insert(code.image.end(), pool_.begin(), pool_.end());

  for (const auto& unit : units_)
    if (unit->pou >= 0 && unit->pou == code.program) walk(*unit->type, program_at_, "", false, true);
  walk(*globals_, 0, "", false, true);
}

void Compiler::walk(const Type& type, int cell, const std::string& prefix, bool retain, bool shown) {
  if (type.motion != nullptr) code_->motions.push_back({cell, &type});
  for (const Variable& member : type.members) {
    if (member.section == Section::in_out && type.motion == nullptr) continue;
    const int at = cell + member.offset;
    const std::string name = prefix.empty() ? member.name : prefix + "." + member.name;
    const bool kept = retain || member.retain;
    if (member.retain && !retain) code_->retain.push_back({at, at + member.type->cells - 1});
    const bool output = type.basic == Basic::block && member.section == Section::output;
    const bool hidden = member.section == Section::temp || member.section == Section::in_out ||
                        (type.standard && member.section == Section::local);
    walk_value(*member.type, at, name, kept, shown && !hidden,
               !member.constant && !output && !member.reads_terminal);
  }
}

void Compiler::walk_value(const Type& type, int cell, const std::string& name, bool retain, bool shown,
                          bool writable) {
  constexpr std::int64_t most_listed = 4096;
  if (type.basic == Basic::array) {
    for (std::int64_t i = type.low; i <= type.high; ++i)
      walk_value(*type.element, cell + static_cast<int>(i - type.low) * type.element->cells,
                 fmt::format("{}[{}]", name, i), retain, shown && i - type.low < most_listed, writable);
  } else if (type.basic == Basic::structure || type.basic == Basic::block) {
    walk(type, cell, name, retain, shown);
  } else if (shown && is_elementary(type.basic)) {
    add_symbol(type, cell, name, writable, retain);
  }
}

void Compiler::add_symbol(const Type& type, int cell, const std::string& name, bool writable, bool retain) {
  Symbol symbol;
  symbol.name = name;
  symbol.type = type.name;
  symbol.writable = writable;
  symbol.retain = retain;
  if (type.basic == Basic::real || type.basic == Basic::lreal) {
    symbol.max = type.basic == Basic::real ? static_cast<double>(std::numeric_limits<float>::max())
                                           : std::numeric_limits<double>::max();
    symbol.min = -symbol.max;
  } else {
    const Range range = range_of(type.basic);
    symbol.min = static_cast<double>(range.low);
    symbol.max = static_cast<double>(range.high);
  }
  if (type.basic == Basic::time) symbol.max /= 1000;
  if (type.basic == Basic::enumeration) {
    const auto [low, high] =
        std::minmax_element(type.values.begin(), type.values.end(),
                            [](const EnumValue& a, const EnumValue& b) { return a.value < b.value; });
    symbol.min = static_cast<double>(low->value);
    symbol.max = static_cast<double>(high->value);
  }
  code_->symbols.push_back(std::move(symbol));
  code_->places.push_back({cell, type.basic});
}

}  // namespace drycut::devices::plcopen::st
