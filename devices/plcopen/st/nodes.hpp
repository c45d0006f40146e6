#pragma once
#include <vector>

#include "devices/plcopen/st/code.hpp"

// What the compiler makes of a text: a tree of typed nodes, of which the instructions are made at its end.
namespace drycut::devices::plcopen::st {

struct Node {
  StOp op = StOp::nothing;
  Basic basic = Basic::unknown;
  int line = 0;
  int column = 0;
  int a = -1;
  int b = -1;
  int c = -1;
  std::int64_t imm = 0;
  bool right_side = false;  ///< it stands right of an AND or OR, which take both sides
};

struct Nodes {
  std::vector<Node> nodes;
  std::vector<int> lists;
  std::vector<Span> spans;
  std::vector<Choice> choices;
  std::size_t of_text = 0;  ///< so many are of the text, those behind them of standard blocks

  [[nodiscard]] const Node& node(int number) const { return nodes[static_cast<std::size_t>(number)]; }
};

inline constexpr std::size_t most_instructions = 1'000'000;
/// Makes the instructions of all bodies, which are nodes until then; false if they are more than that.
bool make_instructions(const Nodes& nodes, Compiled& code);

}  // namespace drycut::devices::plcopen::st
