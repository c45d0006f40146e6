#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "devices/plcopen/st/dialect.hpp"
#include "devices/plcopen/st/nodes.hpp"
#include "devices/plcopen/st/parser.hpp"

namespace drycut::devices::plcopen::st {

/// A part of the file that has a name: a POU, one type of a TYPE section, or a VAR_GLOBAL section.
struct Unit {
  enum class Kind : std::uint8_t { program, function_block, function, type, globals, method, interface };
  enum class State : std::uint8_t { untouched, open, done };
  Kind kind = Kind::program;
  State state = State::untouched;
  StToken name;
  std::size_t first = 0;                           ///< token where the declarations begin
  std::size_t body = 0;                            ///< where the statements begin, once declared
  std::size_t end = 0;                             ///< the END_ keyword
  bool standard = false;                           ///< TON and its like
  Unit* owner = nullptr;                           ///< of a method: whose it is
  std::string key;                                 ///< of a method: among the owner's
  std::unordered_map<std::string, Unit*> methods;  ///< by name in lower case; "speed'get", "speed'set"
  StToken base_name;                               ///< EXTENDS
  Unit* base = nullptr;                            ///< the same, once it is known
  std::vector<StToken> interfaces;                 ///< IMPLEMENTS
  bool extended = false;                           ///< something EXTENDS it
  bool abstract = false;
  bool final = false;
  bool closed = false;            ///< PRIVATE or PROTECTED
  std::size_t property_type = 0;  ///< of a GET or SET: where the type begins and ends
  std::size_t property_end = 0;
  bool procedure = false;  ///< a FUNCTION without a result
  const Type* type = nullptr;
  const Type* result = nullptr;  ///< of a FUNCTION
  int pou = -1;
  struct Edge {
    StToken input;
    bool rising = true;
  };
  std::vector<Edge> edges;  ///< of inputs with R_EDGE or F_EDGE
  std::set<int> calls;      ///< POUs that its body calls
  /// Its variables have one place, whoever calls it.
  [[nodiscard]] bool framed() const { return kind == Kind::function || kind == Kind::method; }
  /// Its instances tell their kind, so that the right method is called.
  [[nodiscard]] bool tells_kind() const {
    return extended || !methods.empty() || !interfaces.empty() || base != nullptr;
  }
  int levels = 1;        ///< how deep its statements and operations go; with those that it calls at the end
  int levels_below = 0;  ///< of what it calls
};

/// What people call it: "Ramp", of a method "Ramp.Up".
std::string told_name(const Unit& unit);

/// Behind the name of an input with R_EDGE or F_EDGE: its edge, and its value in the scan before. No name of
/// a text has a quote.
inline constexpr std::string_view edge_mark = "'edge";
inline constexpr std::string_view last_mark = "'last";

/// Behind the name of a PROPERTY: what reads and what writes it. In front of an instance's variables: its
/// kind.
inline constexpr std::string_view get_mark = "'get";
inline constexpr std::string_view set_mark = "'set";
inline constexpr std::string_view kind_name = "'kind";

/// A part of a whole number: w.3.
struct Bits {
  const Type* of = nullptr;
  int shift = 0;
  int width = 1;
};

/// An expression while it is compiled.
struct TypedExpression {
  TypedExpression() = default;
  /// A value that `node` computes; without a node nothing is known of it.
  TypedExpression(const Type* of, Place at, int computed_by = -1, int deep = 1)
      : type(of), place(at), node(computed_by), depth(deep) {}

  const Type* type = type_of(Basic::unknown);
  Place place;
  int node = -1;          ///< its value, or its address
  bool address = false;   ///< it is a variable: `node` is its address
  bool constant = false;  ///< `value` is known; no node yet
  bool untyped = false;   ///< a literal without a type: it takes the type that is asked for
  Cell value = 0;
  int depth = 1;                        ///< of the tree
  std::string name;                     ///< of a variable, for messages
  std::string locked;                   ///< why it is not to be assigned
  bool own_input = false;               ///< of the block whose body is read
  std::optional<std::string> string;    ///< a literal
  bool cam_file = false;                ///< MC_CAM_REF.File
  bool direct = false;                  ///< %MW3: a number of any type of its width
  std::vector<TypedExpression> bounds;  ///< of an ARRAY [*]: the lower and the upper one of each dimension
  int reference = -1;                   ///< it is seen by the reference that this node computes
  std::optional<Bits> bits;             ///< it is a part of the variable at `node`
  bool on_the_way = false;              ///< 32 bits of what has fewer: who takes it decides (CODESYS)

  [[nodiscard]] bool unknown() const { return type->basic == Basic::unknown; }
};

/// Of NULL, and of what is counted with references.
const Type* null_reference();
inline TypedExpression unknown_at(Place place) { return {type_of(Basic::unknown), place}; }
TypedExpression constant(const Type* type, Cell value, Place place, bool untyped = false);
/// A constant whole number as the text has it, a ULINT above 9223372036854775807 too.
std::string whole_text(const TypedExpression& value);
/// The variable at the address that `node` computes.
TypedExpression variable_at(const Type* type, int node, const std::string& name, Place place);
/// One more than the deepest of them.
int depth_over(const std::vector<TypedExpression>& values);

/// Values and the code that computes them: constants, nodes, conversions.
class Values : public Parser {
 public:
  using Parser::Parser;

  /// Tells a problem; what it is about is unknown from then on.
  TypedExpression refuse(Code code, Place place, std::string what, std::string remedy, Place of);
  TypedExpression refuse(Code code, Place place, std::string what, std::string remedy) {
    return refuse(code, place, std::move(what), std::move(remedy), place);
  }

  /// Whether the program is of IEC 61131-3 where it comes upon this difference. Where the scenario says
  /// nothing it is not, and that is noted once.
  bool is_iec(DialectDifference difference, Place place);
  /// TIME of the dialect.
  [[nodiscard]] const Type* time_type() const {
    return type_of(dialect_ == StDialect::iec ? Basic::signed_time : Basic::time);
  }
  /// BOOL..WSTRING by name; nullptr if there is none.
  [[nodiscard]] const Type* type_named(std::string_view name) const {
    const Type* type = elementary_type(name);
    return type != nullptr && type->basic == Basic::time ? time_type() : type;
  }

  /// What a node does.
  [[nodiscard]] StOp computes(int number) const { return node(number).op; }

  /// As a value of type `to`, by the conversions that IEC 61131-3 makes by itself.
  TypedExpression converted(TypedExpression expression, const Type& to);
  TypedExpression literal_as(TypedExpression literal, const Type& to);
  /// The same with a '-' before it; a problem where no LINT holds it.
  TypedExpression negated_literal(TypedExpression literal);
  /// By a conversion function.
  TypedExpression cast(const TypedExpression& expression, Basic to, Place place);
  /// What can no longer be assigned to.
  TypedExpression as_value(TypedExpression expression);
  /// An operation without effects; of constants its result.
  TypedExpression apply_op(StOp op, const Type* type, Place place, const TypedExpression& a,
                           const TypedExpression& b);
  TypedExpression apply_op(StOp op, const Type* type, Place place, const TypedExpression& a);

  /// Arithmetic of whole numbers: the result has as many bits as the dialect gives it on its way.
  TypedExpression computed(StOp op, const Type* type, Place place, TypedExpression a, TypedExpression b);
  /// What has more bits than its type on its way, as a value of type `to` of at most 32.
  TypedExpression taken_as(TypedExpression expression, Basic to);

  int value_node(const TypedExpression& expression);
  int address_plus(int node, std::int64_t offset);
  int add_node(StOp op, Basic basic, Place place, int a = -1, int b = -1, int c = -1, std::int64_t imm = 0);
  /// A node that has no other nodes.
  int leaf_node(StOp op, Basic basic, Place place, std::int64_t imm) {
    return add_node(op, basic, place, -1, -1, -1, imm);
  }
  int add_list(const std::vector<int>& items);
  int add_span(const Span& span);
  int literal_string(const std::string& text, Place place);
  /// The address of cells for a value on its way.
  int scratch(const Type& type, Place place);
  /// What functions of STRING give.
  const Type* longest_string(bool wide);
  /// A node of TextOp `op`; texts get a place of their own for each call in the text. `number` is the type of
  /// what is none.
  TypedExpression text_value(TextOp op, const Type* number, const std::vector<TypedExpression>& inputs,
                             bool wide, Place place);

 protected:
  [[nodiscard]] const Node& node(int number) const { return nodes_.node(number); }
  [[nodiscard]] Pou& pou(const Unit& unit) { return code_->pous[static_cast<std::size_t>(unit.pou)]; }

  std::shared_ptr<Compiled> code_ = std::make_shared<Compiled>();
  Nodes nodes_;
  std::vector<Cell> pool_;  ///< literals and scratch, placed last
  Unit* unit_ = nullptr;    ///< whose text is being read
  std::optional<StDialect> dialect_;
  int right_sides_ = 0;  ///< what is read stands right of so many AND and OR

 private:
  TypedExpression in_subrange(const TypedExpression& value, const Type& to);
  TypedExpression clock_cast(const TypedExpression& value, Basic to, Place place);
  std::optional<TypedExpression> character_converted(const TypedExpression& value, const Type& to);
  TypedExpression reference_converted(TypedExpression expression, const Type& to);
  TypedExpression folded(StOp op, const Type* type, Place place, Cell a, Cell b, bool untyped);
  void note_loss(StOp op, Basic basic, Place place, Cell before, Cell result);
  int bits_node(const TypedExpression& expression);
  int in_pool(std::size_t cells);

  std::set<DialectDifference> differences_;  ///< that have been noted
  std::unordered_map<std::string, int> strings_;
  const Type* longest_string_ = nullptr;
  const Type* longest_wide_ = nullptr;
};

/// One operator between two values.
struct Operator {
  enum class Kind : std::uint8_t { logic, lazy, comparison, arithmetic, modulo, power };
  std::string_view sign;
  int level = 0;  ///< of precedence, 0 is the weakest
  Kind kind = Kind::logic;
  StOp op = StOp::nothing;       ///< of whole numbers and BOOL
  StOp real_op = StOp::nothing;  ///< of real numbers
};
/// Above it stand **, and the signs before a value.
inline constexpr int strongest_level = 6;
/// nullptr if there is none of this sign or word, any case.
const Operator* find_operator(const StToken& token);

/// `a sign b`; problems are told at `told`, the sign or a function's name. `wanted` is the type that the
/// context asks for, or nullptr: it decides only where the parts leave it open, for literals.
TypedExpression binary(Values& values, std::string_view sign, const StToken& told, TypedExpression a,
                       TypedExpression b, const Type* wanted);
/// -x, +x and NOT x.
TypedExpression signed_value(Values& values, const StToken& sign, TypedExpression operand,
                             const Type* wanted);
TypedExpression complement(Values& values, const StToken& sign, TypedExpression operand, const Type* wanted);
/// How wide a literal is decides what NOT and the shifts make of it.
TypedExpression literal_for_bits(Values& values, TypedExpression value, const Type* wanted,
                                 const StToken& function);

/// "INT_TO_WORD(...)": what makes bits of a number, or a number of bits.
std::string as_other_kind(const TypedExpression& value);

/// Where one is a CHAR and the other a literal text, that is a CHAR, too.
void take_characters(Values& values, TypedExpression& a, TypedExpression& b);

/// The type that both take by themselves; nullptr if there is none.
const Type* common_type(const TypedExpression& a, const TypedExpression& b, const Type* wanted);
/// Of a REAL functions are REAL, of LREAL LREAL; of whole numbers LREAL unless the context wants a REAL.
const Type* real_result(const TypedExpression& value, const Type* wanted);

// The standard functions of IEC 61131-3, operators as functions among them, and conversions.

/// What an argument means, where the context asks for a type.
using Typed = std::function<TypedExpression(const Tree& argument, const Type* wanted)>;
/// The call of the function `name`; nothing if there is none of this name, any case. Gives up what does not
/// fit its inputs.
std::optional<TypedExpression> standard_call(Values& values, const StToken& name,
                                             const std::vector<Argument>& given, const Type* wanted,
                                             const Typed& typed);
std::vector<std::string> standard_function_names();

}  // namespace drycut::devices::plcopen::st
