#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"

namespace drycut::devices::lx3vp::il {

/// An instruction or a label with its operands; at least one word.
using Statement = Words;

/// Tells what is wrong at a place, and what would be right.
using TellLine = std::function<void(Place place, std::string what, std::string remedy)>;

/// Takes a text apart, as it is written by hand or as editors export it:
/// - lines `LD X0`, words by blanks, tabs or commas, comments behind ; or //; before them a step number
///   (`12 LD X0`), around them brackets (`[MOV K5 D0]`);
/// - a table, by tabs or commas, with a heading that names a column Instruction and one I/O or Device: a row
///   an instruction, further operands in columns beside that one, or in rows of their own;
/// in ASCII, UTF-8 or UTF-16 with its byte-order mark.
std::vector<Statement> statements_of(std::string_view text, const TellLine& tell);

/// Whether the text is such a table.
bool is_table(std::string_view text);

}  // namespace drycut::devices::lx3vp::il
