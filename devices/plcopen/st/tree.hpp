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
    member,         ///< parts[0] . token, which is an integer or address for bits
    element,        ///< parts[0] [ the other parts ]
    call,           ///< parts[0] ( the other parts ), each with its ArgumentName
    sign,           ///< token, which is +, - or NOT, of parts[0]
    chain,          ///< parts[0], then tokens[i] and parts[i + 1], signs of one precedence, from the left
    parenthesised,  ///< ( parts[0] )
  };
  /// `name :=` or `name =>` before an argument.
  struct ArgumentName {
    const Token* token = nullptr;  ///< nullptr if there is none
    bool output = false;
  };

  Kind kind = Kind::literal;
  const Token* token = nullptr;  ///< where it is told of
  bool negative = false;
  std::vector<const Token*> tokens;
  std::vector<Tree> parts;
  std::vector<ArgumentName> names;
};

}  // namespace drycut::devices::plcopen::st
