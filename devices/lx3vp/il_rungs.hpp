#pragma once
#include <string>

#include "devices/lx3vp/il_lines.hpp"
#include "devices/lx3vp/il_program.hpp"

namespace drycut::devices::lx3vp::il {

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
  void tell(const Step& step, std::string what, std::string remedy);

  TellLine tell_;
  int blocks_ = 0;    ///< begun and not joined, in this rung
  int branches_ = 0;  ///< kept by MPS
  bool after_output_ = false;
  bool lost_ = false;
};

}  // namespace drycut::devices::lx3vp::il
