#pragma once
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "devices/lx3vp/il_program.hpp"

namespace drycut::devices::lx3vp::il {

/// An instruction or a label with its operands; at least one word.
using Statement = Words;

/// Tells what is wrong at a place, and what would be right.
using TellLine = std::function<void(Code code, Place place, std::string what, std::string remedy)>;

/// Takes a text apart, as it is written by hand or as editors export it:
/// - lines `LD X0`, words by blanks, tabs or commas, comments behind ; or //; before them a step number
///   (`12 LD X0`), around them brackets (`[MOV K5 D0]`);
/// - a table, by tabs or commas, with a heading that names a column Instruction and one I/O or Device: a row
///   an instruction, further operands in columns beside that one, or in rows of their own;
/// in ASCII, UTF-8 or UTF-16 with its byte-order mark.
std::vector<Statement> statements_of(std::string_view text, const TellLine& tell);

/// Whether the text is such a table.
bool is_table(std::string_view text);

/// Watches how instructions follow each other: a rung begins with LD, its blocks are joined, its branches
/// taken up, and it ends with a coil or another instruction that needs power.
class Rungs {
 public:
  explicit Rungs(TellLine tell) : tell_(std::move(tell)) {}
  /// The next instruction; says in the step whether it opens a block.
  void add(Step& step);
  /// An instruction was refused: what follows in its rung is not judged.
  void lose();

 private:
  void open(Step& step);
  void branch(const Step& step);
  void need_contact(const Step& step);
  void need_one_block(const Step& step);
  void end_rung(const Step& step);
  void tell(Code code, const Step& step, std::string what, std::string remedy);

  TellLine tell_;
  int blocks_ = 0;    ///< begun and not joined, in this rung
  int branches_ = 0;  ///< kept by MPS
  bool after_output_ = false;
  bool lost_ = false;
};

/// Where a label stands.
struct Label {
  int line = 0;
  std::size_t place = 0;  ///< among the steps
};
using Labels = std::map<int, Label>;

/// Looks only whether each jump and call has its label.
void find_labels(IlProgram& program, const Labels& labels, const TellLine& tell);

/// Joins what belongs together in a program that is read: jumps and calls with their labels, FOR with NEXT,
/// the steps of sequences, subroutines with SRET; sets Step::target, Step::depth and Program::states. Tells
/// what has no counterpart, stands where it may not, or is jumped into from outside.
void join_structure(IlProgram& program, const Labels& labels, const TellLine& tell);

}  // namespace drycut::devices::lx3vp::il
