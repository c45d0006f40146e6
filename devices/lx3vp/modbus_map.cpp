#include "devices/lx3vp/modbus_map.hpp"

#include <array>

namespace drycut::devices::lx3vp {

namespace {

using Kind = RegisterName::Kind;

constexpr int word_bits = 16;

constexpr std::array rows = {
    ModbusRow{{Kind::m, 0}, last_relay + 1, true, 0x0000, true, "relays"},
    ModbusRow{{Kind::m, first_special}, relays - first_special, true, first_special, true, "special relays"},
    ModbusRow{{Kind::s, 0}, states, true, 0xE000, true, "states"},
    ModbusRow{{Kind::timer_contact, 0}, timers, true, 0xF000, true, "contacts of timers"},
    ModbusRow{{Kind::counter_contact, 0}, counters, true, 0xF400, true, "contacts of counters"},
    ModbusRow{{Kind::x, 0}, terminals, true, 0xF800, false, "inputs, read only"},
    ModbusRow{{Kind::y, 0}, terminals, true, 0xFC00, true, "outputs; what the program drives it drives anew"},
    ModbusRow{{Kind::word, 0}, data_words, false, 0x0000, true, "data; D8000 and above are special"},
    ModbusRow{{Kind::timer, 0}, timers, false, 0xF000, true, "values of timers"},
    ModbusRow{{Kind::counter, 0}, first_wide_counter, false, 0xF400, true, "values of counters"},
    ModbusRow{{Kind::counter, first_wide_counter},
              counters - first_wide_counter,
              false,
              0xF700,
              true,
              "32 bit, two words each, the low word first"},
};

ModbusFormat format_of(const ModbusRow& row) {
  if (row.bits) return ModbusFormat::bit;
  if (row.first.kind == Kind::timer) return ModbusFormat::uint16;
  return addresses_each(row) == 2 ? ModbusFormat::int32 : ModbusFormat::int16;
}

std::optional<ModbusPlace> place_at(ModbusTable table, int address, bool writing) {
  for (const ModbusRow& row : rows) {
    const int offset = address - row.address;
    const int each = addresses_each(row);
    if (row.bits != has_bits(table) || offset < 0 || offset >= row.count * each) continue;
    if (writing && !row.may_write) return std::nullopt;
    auto name = row.first;
    name.number += offset / each;
    // Clients read whole blocks: what is not simulated reads 0 among the rest, and takes nothing.
    if (!is_served(name)) return writing ? std::nullopt : std::optional(ModbusPlace{"", format_of(row)});
    return ModbusPlace{to_string(name), format_of(row), offset % each * word_bits};
  }
  return std::nullopt;
}

}  // namespace

std::span<const ModbusRow> modbus_rows() { return rows; }

int addresses_each(const ModbusRow& row) {
  return row.first.kind == Kind::counter && row.first.number >= first_wide_counter ? 2 : 1;
}

std::optional<ModbusPlace> RegisterFace::read(ModbusTable table, std::uint16_t address) const {
  return place_at(table, address, false);
}

std::optional<ModbusPlace> RegisterFace::written(ModbusTable table, std::uint16_t address) const {
  return place_at(table, address, true);
}

}  // namespace drycut::devices::lx3vp
