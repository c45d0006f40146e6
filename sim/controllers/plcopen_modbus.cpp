// controller: plcopen: modbus: what stands at which address.
#include <fmt/format.h>

#include "base/text.hpp"
#include "devices/plcopen/controller/controller.hpp"
#include "sim/controllers/kinds.hpp"
#include "sim/scenario/archive.hpp"

namespace drycut::sim::controllers {

namespace plcopen = devices::plcopen;
using devices::ModbusFormat;
using devices::ModbusTable;

namespace {

constexpr int addresses = 65536;

/// What words can be; a bit is none of them.
const std::vector<std::string> word_types = {"int16", "uint16", "int32", "uint32", "real32", "real64"};
constexpr std::size_t first_word_type = static_cast<std::size_t>(ModbusFormat::int16);

/// Puts the entries of a section at their addresses and says what does not fit.
class Filler {
 public:
  Filler(plcopen::PlcopenController& controller, const scenario::Scenario& scenario, Problems& problems)
      : controller_(controller), scenario_(scenario), problems_(problems) {}

  void put(ModbusTable table, const scenario::Text& address, const scenario::Text& value, ModbusFormat format,
           bool low_first) {
    const auto number = parsed<int>(address.text);
    const int words = (devices::width_of(format) + 15) / 16;
    if (!number || *number < 0 || *number + words > addresses)
      return problem("controller.bad-name"_code, address.place,
                     fmt::format("'{}' is no address", address.text),
                     fmt::format("0 to {}, as it goes over the wire: 40001 is address 0", addresses - words));
    const auto found = controller_.find(value.text);
    if (!found)
      return problem("controller.unknown-name"_code, value.place,
                     fmt::format("the controller has nothing called '{}'", value.text),
                     did_you_mean(value.text, controller_.names(),
                                  "name a variable of the program, or a value or parameter of an axis"));
    // A word of what is never negative goes to 65535.
    if (format == ModbusFormat::int16 && found->range && found->range->low >= 0)
      format = ModbusFormat::uint16;
    const auto other = controller_.modbus_map().add(table, *number, found->name, format, low_first);
    if (!other.empty())
      problem("controller.twice"_code, address.place,
              fmt::format("{} stands at address {} already", other, *number),
              words == 1 ? "give each an address of its own"
                         : fmt::format("give each addresses of its own: this one takes {}", words));
  }

 private:
  void problem(Code code, const scenario::ScenePlace& place, std::string what, std::string remedy) {
    problems_.push_back(scenario::problem_at(code, scenario_, place, std::move(what), std::move(remedy)));
  }

  plcopen::PlcopenController& controller_;
  const scenario::Scenario& scenario_;
  Problems& problems_;
};

}  // namespace

void visit(scenario::Archive& archive, PlcopenSection::ModbusBit& bit) {
  archive.alone(scenario::form(bit.value));
}

void visit(scenario::Archive& archive, PlcopenSection::ModbusWord& word) {
  const bool plain = word.type == ModbusFormat::int16 && word.order == PlcopenSection::WordOrder::low_first;
  if (archive.instead(plain, scenario::form(word.value))) return;
  archive.in_line();
  archive.value({"value", "a variable of the program, or a value or parameter of an axis"},
                scenario::form(word.value));
  archive.value({"type", "how it lies in words; int16 of a value that is never negative is uint16"},
                scenario::choice_form(
                    word_types, [&word] { return static_cast<std::size_t>(word.type) - first_word_type; },
                    [&word](std::size_t i) { word.type = static_cast<ModbusFormat>(i + first_word_type); }));
  archive.value({"words", "which of several words has the lowest address"},
                scenario::choice_form({"low_first", "high_first"}, word.order));
  archive.require("value", "add value: slLength");
}

void PlcopenSection::visit_modbus(scenario::Archive& archive) {
  const auto bits = [&](std::string_view name, std::string_view meaning, std::vector<ModbusBit>& entries) {
    archive.names({name, meaning, !entries.empty()}, entries, &ModbusBit::address);
  };
  const auto words = [&](std::string_view name, std::string_view meaning, std::vector<ModbusWord>& entries) {
    archive.names({name, meaning, !entries.empty()}, entries, &ModbusWord::address);
  };
  bits("coils", "by address; functions 1, 5 and 15", modbus.coils);
  bits("discrete_inputs", "by address; function 2", modbus.discrete_inputs);
  words("holding_registers", "by address; functions 3, 6, 16, 22 and 23", modbus.holding_registers);
  words("input_registers", "by address; function 4", modbus.input_registers);
}

void PlcopenSection::fill_modbus(plcopen::PlcopenController& controller, const scenario::Scenario& scenario,
                                 Problems& problems) const {
  Filler filler(controller, scenario, problems);
  const auto bits = [&](ModbusTable table, const std::vector<ModbusBit>& entries) {
    for (const auto& [address, value] : entries) filler.put(table, address, value, ModbusFormat::bit, true);
  };
  const auto words = [&](ModbusTable table, const std::vector<ModbusWord>& entries) {
    for (const auto& [address, value, type, order] : entries)
      filler.put(table, address, value, type, order == WordOrder::low_first);
  };
  bits(ModbusTable::coils, modbus.coils);
  bits(ModbusTable::discrete_inputs, modbus.discrete_inputs);
  words(ModbusTable::holding_registers, modbus.holding_registers);
  words(ModbusTable::input_registers, modbus.input_registers);
}

}  // namespace drycut::sim::controllers
