#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "devices/plcopen/st/compiler.hpp"
#include "devices/plcopen/st/references.hpp"

// Where everything is in the memory: VAR_GLOBAL, the FUNCTIONs, the PROGRAMs, literals; and the symbols.
namespace drycut::devices::plcopen::st {
namespace {

StSymbol symbol_of(const Type& type, const std::string& name, bool writable, bool retain) {
  StSymbol symbol;
  symbol.name = name;
  symbol.type = type.name;
  symbol.writable = writable;
  symbol.retain = retain;
  if (type.basic == Basic::real || type.basic == Basic::lreal) {
    symbol.max = type.basic == Basic::real ? static_cast<double>(std::numeric_limits<float>::max())
                                           : std::numeric_limits<double>::max();
    symbol.min = -symbol.max;
  } else {
    const Subrange range = range_of(type);
    symbol.min = static_cast<double>(range.low);
    symbol.max = static_cast<double>(range.high);
  }
  if (is_wide(type.basic) && !type.subrange)
    symbol.max = static_cast<double>(std::numeric_limits<std::uint64_t>::max());
  if (is_clock(type.basic)) {
    symbol.unit = "s";
    symbol.min /= per_second(type.basic);
    symbol.max /= per_second(type.basic);
  }
  if (type.basic == Basic::enumeration) {
    const auto [low, high] =
        std::minmax_element(type.values.begin(), type.values.end(),
                            [](const EnumValue& a, const EnumValue& b) { return a.value < b.value; });
    symbol.min = static_cast<double>(low->value);
    symbol.max = static_cast<double>(high->value);
  }
  return symbol;
}

}  // namespace

void Compiler::place_memory() {
  int next = globals_->cells;
  const auto place = [&](const Type& type) {
    const int at = next;
    if (next > most_cells) return at;
    next += type.cells;
    if (next > most_cells)
      complain("st.too-large"_code, {1, 1}, "the variables take too much memory",
               "8 MB at most, all programs together");
    return at;
  };
  for (const auto& unit : units_)
    if (unit->pou >= 0 && unit->framed()) pou(*unit).frame = place(*unit->type);
  for (std::size_t i = 0; i < code_->instances.size(); ++i)
    code_->instances[i].cell = place(*connections_[i].unit->type);
  memory_ = std::max(next, 1);
}

/// Variables at terminals are in VAR_GLOBAL or in a program, which may be one that does not run.
void Compiler::place_located() {
  Compiled& code = *code_;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < code.located.size(); ++i) {
    const auto instance = std::find_if(code.instances.begin(), code.instances.end(),
                                       [&](const auto& one) { return one.pou == located_in_[i]; });
    if (located_in_[i] >= 0 && instance == code.instances.end()) continue;
    code.located_cells[kept] = code.located_cells[i];
    code.located_cells[kept].cell += located_in_[i] >= 0 ? instance->cell : 0;
    if (kept != i) code.located[kept] = std::move(code.located[i]);
    ++kept;
  }
  code.located.resize(kept);
  code.located_cells.resize(kept);
  place_in_memory();
}

/// The same of those in memory, which then have the names that people give them.
void Compiler::place_in_memory() {
  Compiled& code = *code_;
  std::vector<Program::InMemory> kept;
  for (std::size_t i = 0; i < code.in_memory.size(); ++i) {
    auto& variable = code.in_memory[i];
    if (memory_in_[i] >= 0) {
      const auto instance = std::find_if(code.instances.begin(), code.instances.end(),
                                         [&](const auto& one) { return one.pou == memory_in_[i]; });
      if (instance == code.instances.end()) continue;
      const auto number = static_cast<std::size_t>(instance - code.instances.begin());
      if (code.instances.size() > 1) variable.name = code.instance_names[number].name + "." + variable.name;
    }
    kept.push_back(std::move(variable));
  }
  code.in_memory = std::move(kept);
}

void Compiler::finish() {
  Compiled& code = *code_;
  place_located();
  for (Node& node : nodes_.nodes) {
    if (node.op != StOp::address_pool) continue;
    node.op = StOp::address;
    node.imm += memory_;
  }
  if (told() > 0) {
    // Not to be run; who does finds a memory and nothing to do.
    code.instances.clear();
    code.image.assign(static_cast<std::size_t>(std::min(memory_, most_cells)), 0);
    return;
  }
  code.image.assign(static_cast<std::size_t>(memory_), 0);
  const auto fill = [&](const Type& type, int at) {
    std::copy(type.initial.begin(), type.initial.end(), code.image.begin() + at);
  };
  fill(*globals_, 0);
  for (const auto& unit : units_)
    if (unit->pou >= 0 && unit->framed()) fill(*unit->type, pou(*unit).frame);
  for (std::size_t i = 0; i < code.instances.size(); ++i)
    fill(*connections_[i].unit->type, code.instances[i].cell);
  code.image.insert(code.image.end(), pool_.begin(), pool_.end());
  if (!code.referents.empty()) find_kinds();
  if (!make_instructions(nodes_, code)) {
    complain("st.too-large"_code, {1, 1}, "the statements and operations are too many",
             fmt::format("{} at most", most_instructions));
    code.instances.clear();
    return;
  }

  for (std::size_t i = 0; i < code.instances.size(); ++i) {
    // One program's variables need no name before them.
    const std::string prefix = code.instances.size() == 1 ? "" : code.instance_names[i].name;
    code.scopes.push_back({connections_[i].unit->type->name, prefix.empty() ? "" : prefix + "."});
    walk(*connections_[i].unit->type, code.instances[i].cell, prefix, false, true);
  }
  walk(*globals_, 0, "", false, true);
}

/// Which cells are plain data, so that a reference may see them as something else.
void Compiler::find_kinds() {
  code_->kinds.assign(code_->image.size(), Basic::unknown);
  mark_kinds(*globals_, 0);
  for (const auto& unit : units_)
    if (unit->pou >= 0 && unit->framed()) mark_kinds(*unit->type, pou(*unit).frame);
  for (std::size_t i = 0; i < code_->instances.size(); ++i)
    mark_kinds(*connections_[i].unit->type, code_->instances[i].cell);
}

void Compiler::mark_kinds(const Type& type, int cell) {
  for (const Variable& member : type.members)
    if (member.section != VarClass::in_out && member.type->open == 0 && member.name != kind_name)
      mark_kinds(*member.type, cell + member.offset);
  if (type.basic == Basic::array)
    for (int at = 0; at < type.cells; at += type.element->cells) mark_kinds(*type.element, cell + at);
  if (is_elementary(type.basic) || type.basic == Basic::string)
    std::fill_n(code_->kinds.begin() + cell, type.cells, type.basic);
}

void Compiler::walk(const Type& type, int cell, const std::string& prefix, bool retain, bool shown) {
  if (type.motion != nullptr) code_->motions.push_back({cell, &type});
  for (const Variable& member : type.members) {
    if (member.section == VarClass::in_out && type.motion == nullptr) continue;
    const int at = cell + member.offset;
    const std::string name = prefix.empty() ? member.name : prefix + "." + member.name;
    if (member.refers_to)
      code_->image[static_cast<std::size_t>(at)] =
          cell_of_reference(member.refers_to->referent, cell + member.refers_to->offset);
    const bool kept = retain || member.retain;
    if (member.retain && !retain) code_->retain.push_back({at, at + member.type->cells - 1});
    const bool output = type.basic == Basic::block && member.section == VarClass::output;
    const bool hidden = member.section == VarClass::temp || member.section == VarClass::in_out ||
                        (type.standard && member.section == VarClass::local) ||
                        member.name.find('\'') != std::string::npos;
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
    if (type.basic == Basic::block && type.motion == nullptr && shown)
      code_->scopes.push_back({type.name, name + "."});
    walk(type, cell, name, retain, shown);
  } else if (shown && is_elementary(type.basic)) {
    code_->symbols.push_back(symbol_of(type, name, writable, retain));
    code_->places.push_back({cell, type.basic});
  }
}

}  // namespace drycut::devices::plcopen::st
