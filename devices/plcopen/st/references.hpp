#pragma once
#include <cstdint>

#include "devices/plcopen/st/code.hpp"

// A reference says what it is of, where that begins and how many bytes it is behind its beginning, so that
// programs may count with it as with an address: REF(text) + 3 is the fourth character. What it is of is seen
// as bytes, the lowest first, whatever its type: a REF_TO DWORD that is of a REAL sees the REAL's bits.
namespace drycut::devices::plcopen::st {

/// Of a reference's cell: 16 bits for the Referent, counted from 1, 24 for the cell, 24 for the bytes. 0 is
/// NULL.
struct Reference {
  std::int64_t referent = -1;
  std::int64_t place = 0;
  std::int64_t bytes = 0;
};
inline constexpr std::int64_t most_referents = 32'000;
inline constexpr std::int64_t most_places = 1 << 24;
Cell cell_of_reference(std::int64_t referent, std::int64_t place);
Reference reference_of(Cell cell);

/// Bytes of a value: 1 of a BOOL and of a character.
int bytes_of(Basic basic);
/// Of all of a type, without gaps: SIZEOF.
std::int64_t bytes_of(const Type& type);
/// Whether it is made of values of one elementary type, or characters, so that it can be seen as bytes; of
/// which.
Basic uniform(const Type& type);

/// The value of type `basic` that begins `bytes` behind the first of `cells`, which are of type `of`. What
/// lies outside is the caller's to refuse.
Cell seen_as(Basic basic, std::int64_t bytes, Basic of, const Cell* cells);
/// Puts it there.
void put_as(Basic basic, Cell value, std::int64_t bytes, Basic of, Cell* cells);

}  // namespace drycut::devices::plcopen::st
