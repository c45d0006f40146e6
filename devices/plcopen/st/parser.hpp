#pragma once
#include <cstdint>
#include <vector>

#include "devices/plcopen/st/lexer.hpp"

namespace drycut::devices::plcopen::st {

/// An expression as it is written, before anything is known of its names. Tokens are those of the file.
struct Tree {
  enum class Kind : std::uint8_t {
    literal,        ///< token: a number, time, date or text
    typed,          ///< token # tokens[0]: INT#5, State#Idle; `negative`: INT#-5
    name,           ///< token
    address,        ///< token: %IX0.0, %MW3
    member,         ///< parts[0] . token, which is an integer or address for bits
    element,        ///< parts[0] [ the other parts ]
    dereference,    ///< parts[0] ^
    call,           ///< parts[0] ( the other parts ), each with its ArgumentName
    sign,           ///< token, which is +, - or NOT, of parts[0]
    chain,          ///< parts[0], then tokens[i] and parts[i + 1], signs of one precedence, from the left
    parenthesised,  ///< ( parts[0] )
  };
  /// `name :=` or `name =>` before an argument.
  struct ArgumentName {
    const StToken* token = nullptr;  ///< nullptr if there is none
    bool output = false;
    const StToken* negated = nullptr;  ///< NOT q => x
  };

  Kind kind = Kind::literal;
  const StToken* token = nullptr;  ///< where it is told of
  bool negative = false;
  std::vector<const StToken*> tokens;
  std::vector<Tree> parts;
  std::vector<ArgumentName> names;
};

/// One argument of a call.
struct Argument {
  const StToken* name = nullptr;  ///< nullptr if there is none
  bool output = false;
  const StToken* negated = nullptr;
  const Tree* tree = nullptr;
};
std::vector<Argument> arguments(const Tree& call);

/// From tokens to the trees of expressions. Operators by their precedence (IEC 61131-3, as CODESYS reads it):
/// parentheses and calls, **, - and NOT, then those of operators.hpp from the strongest on.
class Parser : public Reader {
 public:
  using Reader::Reader;

 protected:
  Tree tree();
  /// A name and what follows it: .member, [index] and (arguments); or an address.
  Tree name_tree();
  Tree call_tree(Tree callee);

  int nesting_ = 0;  ///< of statements, types and expressions

 private:
  Tree tree(int level);
  Tree unary_tree();
  Tree power_tree();
  Tree primary_tree();
  Tree member_tree(Tree owner);
  Tree element_tree(Tree owner);
};

}  // namespace drycut::devices::plcopen::st
