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
#include <utility>
#include <vector>

#include "devices/plcopen/st/code.hpp"
#include "devices/plcopen/st/lexer.hpp"

namespace drycut::devices::plcopen::st {

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
  Unit* find_unit(std::string_view name);
  void declare(Unit& unit);
  void check_programs();
  void check_calls();
  bool calls_itself(int pou, std::set<int>& seen, int wanted) const;

  // declarations.cpp: VAR sections.
  void declare_pou(Unit& unit);
  void declare_function_result(Unit& unit, Type& type);
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
  const Type* named_type();
  const Type* cam_ref();
  const Type* motion_type(const BlockType& block);
  Type& new_type(Basic basic, std::string name);
  static void append(Type& owner, Variable variable, std::span<const Cell> initial);

  // initial_values.cpp
  std::vector<Cell> initial_value(const Type& type);
  void initial_into(const Type& type, std::span<Cell> cells);
  void initial_array(const Type& type, std::span<Cell> cells);
  void initial_members(const Type& type, std::span<Cell> cells);
  Expression constant_expression(const Type& wanted);
  std::int64_t constant_integer(std::string_view what);
  /// Notes a table's file that the text names.
  void cam_file(const Token& text);

  // names.cpp: what a name means.
  Expression name_expression();
  std::optional<Expression> variable(const Token& name);
  std::optional<Expression> enum_value(const Token& name);
  std::optional<Expression> predefined(const Token& name);
  Expression qualified_enum(const Type& type);
  Expression typed_literal(const Token& name);
  Expression selected(Expression expression);
  Expression member_of(const Expression& owner);
  Expression element_of(const Expression& owner);
  Expression variable_of(const Variable& variable, int node, const std::string& name);
  [[nodiscard]] std::vector<std::string> known_names() const;

  // expressions.cpp
  Expression expression();
  Expression expression(int level);
  Expression unary();
  Expression powers();
  Expression primary();
  Expression binary(const Token& sign, Expression a, Expression b);
  Expression arithmetic(const Token& sign, Expression a, Expression b);
  Expression time_arithmetic(const Token& sign, Expression a, Expression b);
  Expression logic(const Token& sign, Expression a, Expression b);
  Expression comparison(const Token& sign, Expression a, Expression b);
  Expression string_comparison(Op op, const Token& sign, const Expression& a, const Expression& b);
  Expression apply_op(Op op, const Type* type, Place place, const Expression& a, const Expression& b);
  Expression apply_op(Op op, const Type* type, Place place, const Expression& a);
  Expression folded(Op op, const Type* type, Place place, Cell a, Cell b, bool untyped);
  Expression mismatch(const Token& sign, const Expression& a, const Expression& b, const std::string& remedy);
  /// The type that both take by themselves; nullptr if there is none.
  const Type* common_type(const Expression& a, const Expression& b) const;
  const Type* common_literals(const Expression& a, const Expression& b) const;

  // values.cpp: conversions and nodes.
  Expression converted(Expression expression, const Type& to);
  Expression literal_as(Expression literal, const Type& to);
  Expression cast(const Expression& expression, Basic to, Place place);
  int value_node(const Expression& expression);
  int address_plus(int node, std::int64_t offset);
  int add_node(Op op, Basic basic, Place place, int a = -1, int b = -1, int c = -1, std::int64_t imm = 0);
  int add_list(const std::vector<int>& items);
  int literal_string(const std::string& text);
  int scratch();
  Expression constant(const Type* type, Cell value, Place place, bool untyped = false) const;

  // functions.cpp, calls.cpp
  struct Argument {
    Token name;  ///< of kind end if there is none
    bool output = false;
    Expression value;
  };
  std::vector<Argument> arguments();
  Expression call(const Token& name);
  Expression standard_call(const StandardFunction& function, const Token& name);
  Expression minmax(const Token& name, std::vector<Expression> values, bool largest);
  Expression select_call(const Token& name, const std::vector<Expression>& values);
  Expression multiplex_call(const Token& name, const std::vector<Expression>& values);
  Expression conversion_call(Basic from, Basic to, const Token& name, bool truncates);
  std::vector<Expression> plain_arguments(const Token& name, std::size_t least, std::size_t most);
  std::optional<std::vector<Expression>> to_chosen(const std::vector<Expression>& values, const Token& name);
  std::optional<std::vector<Expression>> to_common(const std::vector<Expression>& values, const Token& name);
  Expression user_call(Unit& unit, const Token& name);
  int block_call(const Expression& instance);
  void input_of(const Expression& instance, const Type& type, const Argument& argument,
                std::set<std::string>& given, std::vector<int>& before, std::vector<int>& after);
  int in_out_store(const Type& type, const Variable& pin, const Argument& argument, int place);
  int output_store(const Type& owner, const Variable& pin, const Argument& argument, int place);
  const Variable* pin_of(const Type& type, const Token& name, bool output);
  static std::vector<std::string> pins_of(const Type& type, bool output);

  // statements.cpp, loops.cpp
  void compile_body(Unit& unit);
  int statements(std::initializer_list<std::string_view> closing);
  int statements_until(const std::function<bool()>& closes);
  int statement();
  int assignment_or_call();
  int assign(const Expression& target, const Expression& value);
  int if_statement();
  int case_statement();
  void case_labels(const Type& selector, std::vector<std::pair<Range, Place>>& labels);
  [[nodiscard]] bool at_label() const;
  int for_statement();
  int while_statement();
  int repeat_statement();
  int jump(Op op);
  int condition(std::string_view closing);
  void close(const Token& opened, std::string_view closing);

  // layout.cpp
  void place_memory();
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
  Unit* unit_ = nullptr;     ///< whose text is being read
  Type* globals_ = nullptr;  ///< its variables are where the memory begins
  std::vector<std::pair<std::string, const Type*>> enumerations_;
  std::map<const BlockType*, const Type*> motions_;
  const Type* cam_ref_ = nullptr;
  std::set<std::string> told_;  ///< names that are not known, told once a POU
  std::vector<Cell> pool_;      ///< literals and scratch, placed last
  std::vector<bool> located_in_globals_;
  std::map<std::string, int> strings_;
  int program_at_ = 0;
  int memory_ = 0;  ///< cells before the pool
  int nesting_ = 0;
  int loops_ = 0;
};

}  // namespace drycut::devices::plcopen::st
