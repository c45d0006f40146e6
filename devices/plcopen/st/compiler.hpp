#pragma once
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "devices/plcopen/st/code.hpp"
#include "devices/plcopen/st/lexer.hpp"
#include "devices/plcopen/st/tree.hpp"

namespace drycut::devices::plcopen::st {

/// Cells of all variables, 8 MB: far above what such controllers have.
inline constexpr int most_cells = 1'000'000;

/// A part of the file that has a name: a POU, one type of a TYPE section, or a VAR_GLOBAL section.
struct Unit {
  enum class Kind : std::uint8_t { program, function_block, function, type, globals };
  enum class State : std::uint8_t { untouched, open, done };
  Kind kind = Kind::program;
  State state = State::untouched;
  Token name;
  std::size_t first = 0;  ///< token where the declarations begin
  std::size_t body = 0;   ///< where the statements begin, once declared
  std::size_t end = 0;    ///< the END_ keyword
  bool standard = false;  ///< TON and its like
  const Type* type = nullptr;
  const Type* result = nullptr;  ///< of a FUNCTION
  int pou = -1;
  std::set<int> calls;  ///< POUs that its body calls
  int levels = 1;  ///< how deep the machine calls itself for its body; with those that it calls at the end
  int levels_below = 0;  ///< of what it calls
};

/// A part of a whole number: w.3.
struct Bits {
  const Type* of = nullptr;
  int shift = 0;
  int width = 1;
};

/// An expression while it is compiled.
struct Expression {
  Expression() = default;
  Expression(const Type* of, Place at) : type(of), place(at) {}

  const Type* type = type_of(Basic::unknown);
  Place place;
  int node = -1;          ///< its value, or its address
  bool address = false;   ///< it is a variable: `node` is its address
  bool constant = false;  ///< `value` is known; no node yet
  bool untyped = false;   ///< a literal without a type: it takes the type that is asked for
  Cell value = 0;
  int depth = 1;                      ///< of the tree
  std::string name;                   ///< of a variable, for messages
  std::string locked;                 ///< why it is not to be assigned
  std::optional<std::string> string;  ///< a literal
  bool cam_file = false;              ///< MC_CAM_REF.File
  std::optional<Bits> bits;           ///< it is a part of the variable at `node`

  [[nodiscard]] bool unknown() const { return type->basic == Basic::unknown; }
};

/// One standard function, see functions.cpp.
struct StandardFunction;

/// Reads a file: first all declarations, then all bodies. A statement that cannot be understood is given up
/// at its end, so that one run tells all faults.
class Compiler {
 public:
  Compiler(std::string_view text, const std::string& file, Problems& problems);
  std::shared_ptr<const Compiled> run();

 private:
  /// Thrown when a statement or a declaration is given up; its problem has been told.
  struct GiveUp {};

  // parser.cpp: tokens and complaints.
  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const;
  const Token& take();
  bool accept(std::string_view sign);
  bool accept_word(std::string_view keyword);
  void expect(std::string_view sign, std::string_view where);
  void expect_word(std::string_view keyword, std::string_view where);
  Token expect_name(const std::string& what);
  /// The remedy for a word that is not known; a file full of them is not searched for each.
  std::string suggested(std::string_view word, const std::function<std::vector<std::string>()>& known,
                        const std::string& otherwise) const;
  void complain(Place place, std::string what, std::string remedy);
  [[noreturn]] void give_up(Place place, std::string what, std::string remedy);
  void skip_statement();
  [[nodiscard]] Place behind() const;

  // units.cpp: the parts of the file.
  void find_units(bool standard);
  void find_types();
  std::size_t find_type(std::size_t first);
  void add_unit(Unit unit);
  std::size_t end_of_unit(std::size_t opening, std::string_view closing);
  [[nodiscard]] Unit* find_unit(std::string_view name) const;
  void declare(Unit& unit);
  void check_programs();
  void check_calls();
  void check_depth();
  void tell_recursion(const Unit& called, const Unit& caller);

  // configuration.cpp
  void find_configuration();
  void read_configuration();
  void configuration_part(bool tasks, int& resources);
  void declare_task();
  void declare_instance();
  void add_instance(const Token& name, int task, Unit& unit, std::size_t connections);
  void check_instances();
  void connect_instances();

  // declarations.cpp: VAR sections.
  void declare_pou(Unit& unit);
  void declare_function_result(Unit& unit, Type& type);
  static void name_standard_pins(Type& type);
  static void fill_empty(Type& type);
  struct VarSection {
    Section section = Section::local;
    bool constant = false;
    bool retain = false;
    bool external = false;
    bool global = false;
  };
  bool variable_section(Unit& unit, Type& owner);
  std::optional<VarSection> section_header();
  void declare_variables(Unit& unit, Type& owner, const VarSection& section);
  void declare_named(Unit& unit, Type& owner, const VarSection& section, const std::vector<Token>& names);
  void add_variable(Unit& unit, Type& owner, const VarSection& section, const Token& name, const Type* type,
                    const std::optional<Address>& location, std::span<const Cell> initial);
  bool check_section(const Unit& unit, const VarSection& section, const Token& name, const Type& type,
                     const std::optional<Address>& location);
  void external(const Token& name, const Type* type);
  std::optional<Address> location();
  bool name_is_free(const Unit& unit, const Type& owner, const Token& name);

  // type_declarations.cpp
  void declare_type(Unit& unit);
  void declare_structure(Type& type);
  void declare_enumeration(Type& type);
  const Type* parse_type();
  const Type* array_type();
  const Type* string_type();
  const Type* subrange(const Type& base);
  const Type* named_type();
  const Type* cam_ref();
  const Type* motion_type(const BlockType& block);
  Type& new_type(Basic basic, std::string name);
  /// Gives up what grows beyond all bounds.
  void check_size(Place place, int cells, int depth);
  static void append(Type& owner, Variable variable, std::span<const Cell> initial);

  // initial_values.cpp
  std::vector<Cell> initial_value(const Type& type);
  void initial_into(const Type& type, std::span<Cell> cells);
  void initial_array(const Type& type, std::span<Cell> cells);
  void initial_members(const Type& type, std::span<Cell> cells);
  Expression constant_expression(const Type& wanted);
  Expression constant_value(std::string_view what, const Type* wanted);
  std::int64_t constant_integer(std::string_view what);
  /// Notes a table's file that the text names.
  void cam_file(const Token& text);

  // trees.cpp: an expression as it is written.
  Tree tree();
  Tree tree(int level);
  Tree unary_tree();
  Tree power_tree();
  Tree primary_tree();
  Tree name_tree();
  Tree member_tree(Tree owner);
  Tree element_tree(Tree owner);
  Tree call_tree(Tree callee);

  // names.cpp: what a name means.
  Expression name_expression(const Token& name, const Type* wanted);
  std::optional<Expression> variable(const Token& name);
  const Type* enumeration(std::string_view name);
  std::optional<Expression> enum_value(const Token& name, const Type* wanted);
  std::optional<Expression> predefined(const Token& name);
  Expression qualified_enum(const Type& type, const Token& name);
  Expression typed_literal(const Tree& tree);
  Expression member_of(const Tree& tree);
  Expression no_member(const Expression& owner, const Token& name);
  Expression bits_of_number(const Tree& tree, const Expression& owner);
  Expression element_of(const Tree& tree);
  Expression element_at(Expression owner, const Expression& index);
  static Expression variable_of(const Variable& variable, int node, const std::string& name, Place place);
  [[nodiscard]] std::vector<std::string> known_names() const;

  // expressions.cpp: what a tree means; `wanted` is the type that the context asks for, or nullptr.
  Expression expression(const Type* wanted = nullptr);
  Expression typed(const Tree& tree, const Type* wanted = nullptr);
  Expression literal(const Token& token);
  Expression signed_value(const Tree& tree, const Type* wanted);
  Expression complement(const Token& sign, Expression operand, const Type* wanted);
  Expression literal_for_bits(Expression value, const Type* wanted, const Token& function);
  Expression binary(std::string_view sign, const Token& told, Expression a, Expression b, const Type* wanted);
  Expression power(const Token& told, const Expression& base, const Expression& exponent, const Type* wanted);
  static const Type* real_result(const Expression& value, const Type* wanted);
  Expression arithmetic(std::string_view sign, const Token& told, Expression a, Expression b,
                        const Type* wanted);
  Expression division_by_zero(const Token& told);
  Expression time_arithmetic(std::string_view sign, const Token& told, Expression a, Expression b);
  Expression clock_arithmetic(std::string_view sign, const Token& told, Expression a, Expression b);
  Expression logic(std::string_view sign, const Token& told, Expression a, Expression b);
  Expression comparison(std::string_view sign, const Token& told, Expression a, Expression b);
  Expression string_comparison(Op op, const Token& told, const Expression& a, const Expression& b);
  Expression apply_op(Op op, const Type* type, Place place, const Expression& a, const Expression& b);
  Expression apply_op(Op op, const Type* type, Place place, const Expression& a);
  Expression folded(Op op, const Type* type, Place place, Cell a, Cell b, bool untyped);
  Expression mismatch(const Token& sign, const Expression& a, const Expression& b, const std::string& remedy);
  /// The type that both take by themselves; nullptr if there is none.
  static const Type* common_type(const Expression& a, const Expression& b, const Type* wanted);
  static const Type* common_literals(const Expression& a, const Expression& b, const Type* wanted);

  // values.cpp: conversions and nodes.
  Expression converted(Expression expression, const Type& to);
  Expression in_subrange(const Expression& value, const Type& to);
  Expression literal_as(Expression literal, const Type& to);
  Expression cast(const Expression& expression, Basic to, Place place);
  /// What can no longer be assigned to.
  Expression as_value(Expression expression);
  int value_node(const Expression& expression);
  int bits_node(const Expression& expression);
  int address_plus(int node, std::int64_t offset);
  int add_node(Op op, Basic basic, Place place, int a = -1, int b = -1, int c = -1, std::int64_t imm = 0);
  int add_list(const std::vector<int>& items);
  int literal_string(const std::string& text);
  int scratch(int cells);
  static Expression constant(const Type* type, Cell value, Place place, bool untyped = false);

  // functions.cpp, calls.cpp
  struct Argument {
    const Token* name = nullptr;  ///< nullptr if there is none
    bool output = false;
    const Tree* tree = nullptr;
  };
  /// EN and ENO of a call; nullptr where they are not given.
  struct Enable {
    const Tree* condition = nullptr;
    const Tree* result = nullptr;
  };
  struct BlockCall {
    std::set<std::string> given;  ///< pins; "?" if something was given that is none
    std::vector<int> before;
    std::vector<int> after;
  };
  static std::vector<Argument> arguments(const Tree& call);
  Enable take_enable(std::vector<Argument>& given, const Type* callee);
  int enable_condition(const Enable& enable, Place place);
  int enable_store(const Enable& enable, bool on);
  Expression enabled(const Enable& enable, Expression value, const Type* wanted);
  Expression call(const Tree& tree, const Type* wanted);
  Expression function_call(const Token& name, const std::vector<Argument>& given, const Type* wanted);
  std::vector<const Tree*> in_order(const Token& name, const std::vector<Argument>& given,
                                    const StandardFunction& function);
  Expression standard_call(const StandardFunction& function, const Token& name,
                           const std::vector<Argument>& given, const Type* wanted);
  Expression operator_call(const StandardFunction& function, const Token& name,
                           const std::vector<Expression>& values, const Type* wanted);
  Expression shift_call(const StandardFunction& function, const Token& name, std::vector<Expression> values,
                        const Type* wanted);
  Expression number_call(const StandardFunction& function, const Token& name, std::vector<Expression> values,
                         const Type* wanted);
  Expression refused(const Token& name, const Expression& value, std::string wanted);
  Expression minmax(const Token& name, const std::vector<Expression>& values, bool largest,
                    const Type* wanted);
  Expression select_call(const Token& name, const std::vector<Expression>& values, const Type* wanted);
  Expression multiplex_call(const Token& name, const std::vector<Expression>& values, const Type* wanted);
  static const Type* chosen_type(const std::vector<Expression>& values);
  Expression text_call(const StandardFunction& function, const Token& name,
                       const std::vector<Expression>& values);
  Expression text_value(TextOp op, const Type* number, const Token& name,
                        const std::vector<Expression>& values);
  Expression moment_call(const Token& name, const std::vector<Expression>& values);
  Expression truncated(Basic to, const Token& name, const Expression& value);
  Expression conversion_call(Basic from, Basic to, const Token& name, Expression value);
  std::optional<std::vector<Expression>> to_chosen(const std::vector<Expression>& values, const Token& name,
                                                   const Type* wanted);
  std::optional<std::vector<Expression>> to_common(const std::vector<Expression>& values, const Token& name,
                                                   const Type* wanted);
  Expression user_call(Unit& unit, const Token& name, const std::vector<Argument>& given);
  std::vector<int> input_triple(const Type& function, const Variable& pin, const Argument& argument,
                                int frame, int& depth);
  bool all_connected(const Unit& unit, const Token& name, const std::vector<Argument>& given,
                     const std::set<const Variable*>& connected, std::size_t number);
  BlockCall block_arguments(const Expression& instance, const std::vector<Argument>& given);
  int block_call(const Expression& instance, const Tree& tree);
  void input_of(const Expression& instance, const Argument& argument, BlockCall& call);
  int in_out_store(const Type& type, const Variable& pin, const Expression& value, int place);
  int output_store(const Type& owner, const Variable& pin, const Argument& argument, int place);
  const Variable* pin_of(const Type& type, const Token& name, bool output);
  static std::vector<std::string> pins_of(const Type& type, bool output);

  // statements.cpp, loops.cpp
  /// By their lower ends: the upper one and where it stands.
  using Labels = std::map<std::int64_t, std::pair<std::int64_t, Place>>;
  void compile_body(Unit& unit);
  int statements(std::initializer_list<std::string_view> closing);
  int statements_until(const std::function<bool()>& closes);
  int sequence_node(std::vector<int> statements, Place place);
  int statement();
  int assignment_or_call();
  int call_statement(const Tree& call);
  int assign(const Expression& target, const Expression& value);
  int store(const Expression& target, int value);
  int if_statement();
  int case_statement();
  std::int64_t case_label(const Type& selector);
  std::vector<Range> case_labels(const Type& selector, Labels& labels);
  [[nodiscard]] bool at_label() const;
  int for_statement();
  int while_statement();
  int repeat_statement();
  int jump(Op op);
  int condition(std::string_view closing);
  void close(const Token& opened, std::string_view closing);

  // layout.cpp
  void place_memory();
  void place_located();
  void finish();
  void walk(const Type& type, int cell, const std::string& prefix, bool retain, bool shown);
  void walk_value(const Type& type, int cell, const std::string& name, bool retain, bool shown,
                  bool writable);
  void add_symbol(const Type& type, int cell, const std::string& name, bool writable, bool retain);

  const std::string& file_;
  Problems& problems_;
  std::size_t first_problem_;
  std::shared_ptr<Compiled> code_ = std::make_shared<Compiled>();
  std::vector<Token> tokens_;
  std::size_t user_tokens_ = 0;  ///< where the file begins, behind the standard blocks
  std::size_t at_ = 0;
  std::size_t stop_ = 0;  ///< end of the part that is being read

  std::vector<std::unique_ptr<Unit>> units_;
  std::unordered_map<std::string, Unit*> unit_index_;          ///< by name in lower case, VAR_GLOBAL apart
  Unit* unit_ = nullptr;                                       ///< whose text is being read
  Unit outside_;                                               ///< sees VAR_GLOBAL only: the CONFIGURATION
  Type* globals_ = nullptr;                                    ///< its variables are where the memory begins
  std::unordered_map<std::string, const Type*> enumerations_;  ///< by name in lower case
  std::multimap<std::string, std::pair<const Type*, std::int64_t>> enum_values_;
  std::map<const BlockType*, const Type*> motions_;
  /// What a CONFIGURATION connects to a program, beside Compiled::instances.
  struct Connections {
    Unit* unit = nullptr;
    Token name;
    std::size_t connections = 0;  ///< where the '(' is, or 0
  };
  std::vector<Connections> connections_;
  std::size_t configuration_first_ = 0;
  std::size_t configuration_end_ = 0;
  const Type* cam_ref_ = nullptr;
  std::set<std::string> told_;   ///< names that are not known, told once a POU
  std::vector<Cell> pool_;       ///< literals and scratch, placed last
  std::vector<int> located_in_;  ///< the POU, -1: VAR_GLOBAL
  std::map<Address, std::string> terminals_;
  std::map<std::string, int> strings_;
  std::int64_t type_cells_ = 0;  ///< of all initial values
  int open_units_ = 0;
  int memory_ = 0;  ///< cells before the pool
  int nesting_ = 0;
  int loops_ = 0;
};

}  // namespace drycut::devices::plcopen::st
