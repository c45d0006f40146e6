#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace drycut::devices::lx3vp::il {

/// A word of an instruction and its place in the text.
struct Word {
  std::string text;
  int line = 1;
  int column = 1;
};
/// An instruction or a label with its operands; at least one word.
using Statement = std::vector<Word>;

/// Tells what is wrong at a line and a column, and what would be right.
using TellLine = std::function<void(int line, int column, std::string what, std::string remedy)>;

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
