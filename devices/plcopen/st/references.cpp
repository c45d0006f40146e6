#include "devices/plcopen/st/references.hpp"

#include <bit>
#include <cstring>

namespace drycut::devices::plcopen::st {
namespace {

/// The value's bits in its width.
std::uint64_t raw(Basic basic, Cell value) {
  if (basic == Basic::real) return std::bit_cast<std::uint32_t>(static_cast<float>(real_of(value)));
  return static_cast<std::uint64_t>(value);
}

Cell from_raw(Basic basic, std::uint64_t bits) {
  if (basic == Basic::real)
    return cell_of(static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits))));
  return basic == Basic::lreal ? static_cast<Cell>(bits) : wrapped(basic, static_cast<Cell>(bits));
}

std::uint8_t byte_at(std::int64_t at, Basic of, const Cell* cells) {
  if (of == Basic::string) return reinterpret_cast<const std::uint8_t*>(cells)[at];
  const int size = bytes_of(of);
  return static_cast<std::uint8_t>(raw(of, cells[at / size]) >> (8 * (at % size)));
}

void put_byte(std::uint8_t byte, std::int64_t at, Basic of, Cell* cells) {
  if (of == Basic::string) {
    reinterpret_cast<std::uint8_t*>(cells)[at] = byte;
    return;
  }
  const int size = bytes_of(of);
  const auto shift = 8 * (at % size);
  Cell& cell = cells[at / size];
  cell = from_raw(of, (raw(of, cell) & ~(std::uint64_t{0xFF} << shift)) | (std::uint64_t{byte} << shift));
}

}  // namespace

Cell cell_of_reference(std::int64_t referent, std::int64_t place) {
  return (referent + 1) << 48 | place << 24;
}

Reference reference_of(Cell cell) {
  return {(cell >> 48) - 1, cell >> 24 & (most_places - 1), cell & (most_places - 1)};
}

int bytes_of(Basic basic) {
  if (basic == Basic::reference) return sizeof(Cell);
  return basic == Basic::string || bits_of(basic) < 8 ? 1 : bits_of(basic) / 8;
}

std::int64_t bytes_of(const Type& type) {
  if (type.basic == Basic::array) return (type.high - type.low + 1) * bytes_of(*type.element);
  if (type.basic == Basic::string) return static_cast<std::int64_t>(type.length) + 1;
  if (is_elementary(type.basic) || type.basic == Basic::reference) return bytes_of(type.basic);
  std::int64_t all = 0;
  for (const Variable& member : type.members) all += bytes_of(*member.type);
  return all;
}

Basic uniform(const Type& type) {
  if (type.basic == Basic::array) {
    const Basic basic = uniform(*type.element);
    return basic == Basic::string ? Basic::unknown : basic;
  }
  return is_elementary(type.basic) || type.basic == Basic::string ? type.basic : Basic::unknown;
}

Cell seen_as(Basic basic, std::int64_t bytes, Basic of, const Cell* cells) {
  const int size = bytes_of(basic);
  if (basic == of && bytes % size == 0) return cells[bytes / size];
  std::uint64_t bits = 0;
  for (int i = 0; i < size; ++i) bits |= std::uint64_t{byte_at(bytes + i, of, cells)} << (8 * i);
  return from_raw(basic, bits);
}

void put_as(Basic basic, Cell value, std::int64_t bytes, Basic of, Cell* cells) {
  const int size = bytes_of(basic);
  if (basic == of && bytes % size == 0) {
    cells[bytes / size] = value;
    return;
  }
  const std::uint64_t bits = raw(basic, value);
  for (int i = 0; i < size; ++i) put_byte(static_cast<std::uint8_t>(bits >> (8 * i)), bytes + i, of, cells);
}

}  // namespace drycut::devices::plcopen::st
