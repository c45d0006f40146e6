#include "sim/live/modbus/face_data.hpp"

#include <cmath>

namespace drycut::sim::live::modbus {

namespace {

using devices::ModbusTable;

constexpr std::uint64_t word_mask = 0xFFFF;

/// The bits of the value that an address is.
std::uint64_t mask_of(ModbusTable table) { return devices::has_bits(table) ? 1 : word_mask; }

std::uint64_t all_bits(devices::ModbusFormat format) {
  return ~std::uint64_t{0} >> (64 - devices::width_of(format));
}

}  // namespace

FaceData::FaceData(const devices::ModbusFace& face, Host host) : face_(face), host_(std::move(host)) {}

const FaceData::Bound& FaceData::bound(ModbusTable table, std::uint16_t address, bool writing) {
  const auto key = static_cast<std::uint32_t>(address) | static_cast<std::uint32_t>(table) << 16U |
                   (writing ? 1U << 20U : 0U);
  const auto [found, is_new] = bound_.try_emplace(key);
  Bound& at = found->second;
  if (!is_new) return at;
  const auto place = writing ? face_.written(table, address) : face_.read(table, address);
  if (!place) return at;
  at.place = *place;
  if (place->value.empty()) {
    at.there = !writing;
  } else if (const auto value = host_.find(place->value)) {
    at.there = !writing || value->write != nullptr;
    at.read = value->read;
  }
  return at;
}

std::uint64_t FaceData::bits_now(const Bound& bound) const {
  if (!bound.read) return 0;
  if (!pending_.empty())
    if (const auto found = pending_.find(bound.place.value); found != pending_.end())
      return devices::to_bits(bound.place.format, found->second.number);
  return devices::to_bits(bound.place.format, bound.read());
}

void FaceData::forget_taken() {
  if (pending_.empty()) return;
  const Time now = host_.now();
  std::erase_if(pending_, [now](const auto& entry) { return now > entry.second.until; });
}

Exception FaceData::read(ModbusTable table, std::uint16_t address, std::span<std::uint16_t> values) {
  forget_taken();
  for (auto& value : values) {
    const auto& at = bound(table, address++, false);
    if (!at.there) return Exception::illegal_data_address;
    value =
        static_cast<std::uint16_t>(bits_now(at) >> static_cast<unsigned>(at.place.shift) & mask_of(table));
  }
  return Exception::none;
}

Exception FaceData::write(ModbusTable table, std::uint16_t address, std::span<const std::uint16_t> values,
                          std::uint16_t mask) {
  forget_taken();
  struct Change {
    const Bound* at;
    std::uint64_t bits;
  };
  std::vector<Change> changes;
  std::unordered_map<std::string_view, std::size_t> by_value;
  for (const auto value : values) {
    const auto& at = bound(table, address++, true);
    if (!at.there) return Exception::illegal_data_address;
    const auto [found, is_new] = by_value.try_emplace(at.place.value, changes.size());
    const auto shift = static_cast<unsigned>(at.place.shift);
    const std::uint64_t touched = (mask & mask_of(table)) << shift & all_bits(at.place.format);
    if (is_new) changes.push_back({&at, touched == all_bits(at.place.format) ? 0 : bits_now(at)});
    auto& bits = changes[found->second].bits;
    bits = (bits & ~touched) | (static_cast<std::uint64_t>(value) << shift & touched);
  }
  std::vector<std::pair<std::string, double>> numbers;
  numbers.reserve(changes.size());
  for (const auto& [at, bits] : changes) {
    const double number = devices::from_bits(at->place.format, bits);
    if (!std::isfinite(number)) return Exception::illegal_data_value;
    numbers.emplace_back(at->place.value, number);
  }
  if (!host_.act(numbers)) return Exception::illegal_data_value;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const auto& place = changes[i].at->place;
    pending_[place.value] = {numbers[i].second, host_.now() + place.settles_ns};
  }
  return Exception::none;
}

}  // namespace drycut::sim::live::modbus
