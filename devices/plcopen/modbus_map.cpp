#include "devices/plcopen/modbus_map.hpp"

#include <fmt/format.h>

#include <charconv>

#include "base/text.hpp"

namespace drycut::devices::plcopen {

namespace {

constexpr int addresses = 65536;
constexpr int word_bits = 16;
constexpr int byte_bits = 8;

}  // namespace

std::optional<MemoryPlace> parse_memory_place(std::string_view text) {
  const auto name = upper(text);
  constexpr std::string_view sizes = "XWDL";
  if (name.size() < 4 || !name.starts_with("%M") || sizes.find(name[2]) == std::string_view::npos)
    return std::nullopt;
  const char* const end = name.data() + name.size();
  MemoryPlace place{name[2], 0};
  auto read = std::from_chars(name.data() + 3, end, place.number);
  if (read.ec != std::errc() || place.number < 0 || place.number >= addresses) return std::nullopt;
  if (place.size == 'X') {
    int bit = 0;
    if (read.ptr == end || *read.ptr != '.') return std::nullopt;
    read = std::from_chars(read.ptr + 1, end, bit);
    if (read.ec != std::errc() || bit < 0 || bit >= byte_bits) return std::nullopt;
    place.number = place.number * byte_bits + bit;
  }
  if (read.ptr != end || (place.number + 1) * addresses_of(place) > addresses) return std::nullopt;
  return place;
}

std::string to_string(const MemoryPlace& place) {
  if (place.size == 'X') return fmt::format("%MX{}.{}", place.number / byte_bits, place.number % byte_bits);
  return fmt::format("%M{}{}", place.size, place.number);
}

int addresses_of(const MemoryPlace& place) {
  if (place.size == 'D') return 2;
  return place.size == 'L' ? 4 : 1;
}

std::string MemoryFace::add(ModbusTable table, int address, const std::string& value, ModbusFormat format,
                            bool low_first) {
  const int width = width_of(format);
  const int count = (width + word_bits - 1) / word_bits;
  for (int i = 0; i < count; ++i)
    if (const auto other = places_.find({table, address + i}); other != places_.end())
      return other->second.value;
  for (int i = 0; i < count; ++i)
    places_[{table, address + i}] = {value, format, word_bits * (low_first ? i : count - 1 - i)};
  return "";
}

std::optional<ModbusPlace> MemoryFace::read(ModbusTable table, std::uint16_t address) const {
  const auto next = places_.lower_bound({table, address});
  if (next == places_.end() || next->first.first != table) return std::nullopt;
  return next->first.second == address ? next->second : ModbusPlace{};
}

std::optional<ModbusPlace> MemoryFace::written(ModbusTable table, std::uint16_t address) const {
  const auto found = places_.find({table, address});
  return found == places_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace drycut::devices::plcopen
