// What programs ask that nobody gives: variables that are read and never set, timers that never start.
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

#include "base/text.hpp"
#include "devices/qmove/qmove_controller.hpp"

namespace drycut::devices::qmove {

namespace {

/// Who reads a cell or a timer first: "cycle.mod:12".
using Readers = std::map<int, std::string>;

struct Uses {
  Readers read;
  std::set<int> written;
  Readers asked;
  std::set<int> started;
  Readers read_by_index;       ///< the array's first cell: any of it
  std::set<int> set_by_index;  ///< the same
};

/// An index that is a number names one cell; else all of the array may be read or written.
void take_element(const QclProgram& program, std::size_t at, const std::string& place, Uses& uses) {
  const Instruction& index = program.code[at];
  const bool reads = at + 1 < program.code.size() && program.code[at + 1].op == QclOp::load_at;
  const bool plain = at > 0 && program.code[at - 1].op == QclOp::push;
  const int first = plain ? index.a + program.code[at - 1].a - 1 : index.a;
  const int end = plain ? first + 1 : index.a + index.b;
  if (!plain && reads) uses.read_by_index.emplace(index.a, place);
  if (!plain && !reads) uses.set_by_index.insert(index.a);
  for (int cell = first; cell < end; ++cell) {
    if (!reads)
      uses.written.insert(cell);
    else if (plain)
      uses.read.emplace(cell, place);
  }
}

void take_uses(const QclProgram& program, Uses& uses) {
  for (std::size_t i = 0; i < program.code.size(); ++i) {
    const auto& [op, a, b] = program.code[i];
    const auto place = fmt::format("{}:{}", program.file, program.lines[i]);
    if (op == QclOp::load) uses.read.emplace(a, place);
    if (op == QclOp::store) uses.written.insert(a);
    if (op == QclOp::load_timer) uses.asked.emplace(a, place);
    if (op == QclOp::store_timer) uses.started.insert(a);
    if (op == QclOp::index) take_element(program, i, place, uses);
  }
}

/// Statements one behind the other that set the same thing: the first one does nothing, and was hardly meant
/// for it.
void tell_twice_set(const ProgramText& program, std::vector<Controller::ProgramDoubt>& found) {
  std::string last;
  int number = 0;
  for (const auto line : split_lines(program.text)) {
    ++number;
    const auto code = trimmed(line.substr(0, line.find(';')));
    if (code.empty()) continue;
    const auto at = code.find('=');
    const auto target = at == std::string_view::npos ? "" : lower(trimmed(code.substr(0, at)));
    const bool is_name = !target.empty() && target.find_first_of(" \t<>") == std::string::npos;
    const bool reads = is_name && lower(code.substr(at)).find(target) != std::string::npos;
    if (is_name && !reads && target == last)
      found.push_back({fmt::format("{}:{}: {} was set just before: the first of the two does nothing",
                                   program.file, number, trimmed(code.substr(0, at)))});
    last = is_name ? target : "";
  }
}

/// Of a retentive array that programs set by number but for some elements: those that any index may read.
void tell_gaps(const NamedThing& array, const Uses& uses, std::vector<Controller::ProgramDoubt>& found) {
  const auto reader = uses.read_by_index.find(array.index);
  if (reader == uses.read_by_index.end() || uses.set_by_index.contains(array.index)) return;
  std::vector<int> gaps;
  for (int i = 0; i < cell_count(array); ++i)
    if (!uses.written.contains(array.index + i)) gaps.push_back(i + 1);
  if (static_cast<int>(gaps.size()) == cell_count(array)) return;  // the panel sets them all
  for (const int gap : gaps) {
    const auto name = fmt::format("{}[{}]", array.name, gap);
    found.push_back(
        {fmt::format("{}: {} is never set, other elements of {} are", reader->second, name, array.name),
         name});
  }
}

}  // namespace

// Retentive values and recipes come from the panel.
std::vector<Controller::ProgramDoubt> QmoveController::doubts() const {
  Uses uses;
  for (const QclProgram& program : programs_) take_uses(program, uses);
  std::vector<ProgramDoubt> found;
  for (const QclProgram& program : programs_) tell_twice_set(module_text(program), found);
  for (const NamedThing& thing : names_.things()) {
    const bool array = thing.kind == NamedThing::Kind::array;
    if (thing.kind == NamedThing::Kind::timer && uses.asked.contains(thing.index) &&
        !uses.started.contains(thing.index))
      found.push_back({fmt::format("{}: the timer {} is asked, and no task starts it",
                                   uses.asked[thing.index], thing.name),
                       thing.name});
    if (thing.kind != NamedThing::Kind::scalar && !array) continue;
    if (thing.index >= names_.volatile_cells()) {
      if (array) tell_gaps(thing, uses, found);
      continue;
    }
    for (int cell = thing.index; cell < thing.index + cell_count(thing); ++cell) {
      if (!uses.read.contains(cell) || uses.written.contains(cell)) continue;
      const auto name = array ? fmt::format("{}[{}]", thing.name, cell - thing.index + 1) : thing.name;
      found.push_back(
          {fmt::format("{}: {} is read, and no task sets it: it stays 0", uses.read[cell], name), name});
    }
  }
  return found;
}

}  // namespace drycut::devices::qmove
