#pragma once
#include <array>
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

#include "devices/plcopen/st/values.hpp"
#include "devices/plcopen/terminals.hpp"

namespace drycut::devices::plcopen::st {

struct AssertionCall;

/// What expressions, assignments and calls mean: names by the declarations, types by the parts; and their
/// code. `wanted` is the type that the context asks for, or nullptr.
class Expressions : public Values {
 public:
  using Values::Values;

 protected:
  TypedExpression expression(const Type* wanted = nullptr) { return typed(tree(), wanted); }
  TypedExpression typed(const Tree& tree, const Type* wanted = nullptr);
  std::optional<TypedExpression> variable(const StToken& name);
  const Variable* find_global(std::string_view name);
  [[nodiscard]] Unit* find_unit(std::string_view name) const;
  /// Reads the declarations of a unit that may be needed before its turn.
  virtual void declare(Unit& unit) = 0;
  /// A VAR CONSTANT of the unit that is being declared, in a section behind what needs it; nothing if there
  /// is none.
  virtual std::optional<TypedExpression> later_constant(const StToken& name) = 0;

  // arrays.cpp
  /// Where the bounds of an ARRAY [*] are kept that the member is: behind it, without a name of the text.
  static std::string bound_name(std::string_view member, std::size_t number);
  /// Gives a variable of such a type its bounds, which `node_at` finds by the cell of its owner.
  void know_bounds(TypedExpression& array, const Type& owner, const std::function<int(int)>& node_at);
  /// Whether an array may stand for an ARRAY [*].
  static bool goes_into_open(const Type& array, const Type& open);
  /// Of an array, as the pin of that type wants them.
  std::vector<TypedExpression> bounds_of(const TypedExpression& array, Place place);

  // assignments.cpp
  int assign(const TypedExpression& target, const TypedExpression& value);
  // methods.cpp
  /// A method, and the instance that it is called of.
  struct Method {
    Unit* unit = nullptr;  ///< nullptr: it is none
    int instance = -1;
    bool fixed = false;  ///< SUPER: the one that is named, whatever the instance is
    Place place = {};
  };
  Method method_of(const Tree& callee, std::string_view mark);
  [[nodiscard]] static Unit* find_method(Unit* unit, const std::string& key);
  /// Whether an instance of `from` may stand for one of `to`: it EXTENDS it.
  [[nodiscard]] bool extends(const Type& from, const Type& to) const;
  std::optional<int> set_property(const Tree& target);
  std::optional<int> super_call(const Tree& callee);

  /// Notes a table's file that the text names.
  void cam_file(const StToken& text);
  int sequence_node(std::vector<int> statements, Place place);
  // assertions.cpp
  /// AssertTrue and its like, as far as the text may call them.
  std::optional<TypedExpression> assertion_call(const StToken& name, const std::vector<Argument>& given);
  [[nodiscard]] bool may_assert() const;
  static bool is_assertion(std::string_view name);
  static void add_assertion_names(std::vector<std::string>& names);
  bool asserts_ = false;  ///< all units may, not only tests

  /// The statements that give an instance's inputs and take its outputs.
  struct BlockCall {
    std::size_t unnamed = 0;      ///< so many arguments had no name
    std::set<std::string> given;  ///< pins; "?" if something was given that is none
    std::vector<int> before;
    std::vector<int> after;
  };
  /// Whether what is called is a function, not an instance.
  bool names_function(const Tree& callee);
  BlockCall block_arguments(const TypedExpression& instance, const std::vector<Argument>& given);
  int block_call(const TypedExpression& instance, const Tree& tree);
  const Variable* pin_of(const Type& type, const StToken& name, bool output);

  std::vector<std::unique_ptr<Unit>> units_;
  std::unordered_map<std::string, Unit*> unit_index_;          ///< by name in lower case, VAR_GLOBAL apart
  Type* globals_ = nullptr;                                    ///< its variables are where the memory begins
  std::unordered_map<std::string, const Type*> enumerations_;  ///< by name in lower case
  std::multimap<std::string, std::pair<const Type*, std::int64_t>> enum_values_;
  std::unordered_map<std::string, Unit*> global_sections_;  ///< VAR_GLOBAL by what it declares
  const Type* cam_ref_ = nullptr;
  /// What is at a place, by the place's name, "%QW2": of VAR_GLOBAL or a PROGRAM, cells behind its beginning.
  struct Seat {
    const Type* owner = nullptr;
    const Type* type = nullptr;
    std::string name;
    int cell = 0;
  };
  std::map<std::string, Seat> seats_;
  bool addresses_declared_ = false;
  std::set<std::string> told_;                           ///< names that are not known, told once a POU
  std::set<std::string> method_names_;                   ///< keys of all methods
  std::unordered_map<std::string, int> method_numbers_;  ///< of those that are called, by their keys
  int open_units_ = 0;
  int memory_ = 0;          ///< cells before the pool, once everything has its place
  bool statement_ = false;  ///< what is called is a statement, not a value

 private:
  // methods.cpp
  [[nodiscard]] Unit* block_unit() const;
  TypedExpression this_instance(Place place);
  TypedExpression method_call(const Method& method, const std::vector<Argument>& given);
  TypedExpression interface_value(const TypedExpression& instance, const Type& interface);

  // expressions.cpp
  TypedExpression chain(const Tree& tree, std::optional<TypedExpression> first, const Type* wanted);
  TypedExpression signed_tree(const Tree& tree, const Type* wanted);
  TypedExpression direct_place(const StToken& token);  // places.cpp
  TypedExpression literal(const StToken& token);
  TypedExpression typed_literal(const Tree& tree);
  TypedExpression name_expression(const StToken& name, const Type* wanted);
  const Type* enumeration(std::string_view name);
  std::optional<TypedExpression> enum_value(const StToken& name, const Type* wanted);
  TypedExpression qualified_enum(const Type& type, const StToken& name);
  TypedExpression member_of(const Tree& tree);
  TypedExpression no_member(const TypedExpression& owner, const StToken& name);
  TypedExpression bits_of_number(const Tree& tree, const TypedExpression& owner);
  TypedExpression element_of(const Tree& tree);
  TypedExpression dereferenced(const Tree& tree);
  std::optional<TypedExpression> reference_call(const StToken& name, const std::vector<Argument>& given);
  int referent(const Type& type);
  TypedExpression element_at(TypedExpression owner, const TypedExpression& index);
  TypedExpression open_element(TypedExpression array, const Tree& tree);
  std::optional<TypedExpression> open_index(const Tree& tree, const TypedExpression& low,
                                            const TypedExpression& high);
  std::optional<TypedExpression> bound_call(const StToken& name, const std::vector<Argument>& given,
                                            const Type* wanted);
  [[nodiscard]] std::vector<std::string> known_names() const;

  // assertions.cpp
  using AssertionInputs = std::array<std::optional<TypedExpression>, 4>;
  /// What an assertion of two values looks at.
  struct Comparison {
    TypedExpression expected;
    TypedExpression actual;
    TypedExpression delta;
    const Type* type = nullptr;  ///< of the values
  };
  std::optional<AssertionInputs> assertion_inputs(const AssertionCall& call, const StToken& name,
                                                  const std::vector<Argument>& given);
  bool make_comparable(Comparison& of, const AssertionCall& call, const std::optional<TypedExpression>& delta,
                       const StToken& name);

  // calls.cpp
  /// EN and ENO of a call; nullptr where they are not given.
  struct Enable {
    const Tree* condition = nullptr;
    const Tree* result = nullptr;
  };
  int store(const TypedExpression& target, int value);
  bool may_assign_input(const TypedExpression& target);
  Enable take_enable(std::vector<Argument>& given, const Type* callee);
  int enable_condition(const Enable& enable, Place place);
  int enable_store(const Enable& enable, bool on);
  TypedExpression enabled(const Enable& enable, TypedExpression value, const Type* wanted);
  TypedExpression call(const Tree& tree, const Type* wanted);
  TypedExpression function_call(const StToken& name, const std::vector<Argument>& given, const Type* wanted);
  TypedExpression user_call(Unit& unit, const StToken& name, const std::vector<Argument>& given,
                            const Method* method = nullptr);
  std::vector<int> input_triple(const Type& function, const Variable& pin, const Argument& argument,
                                int frame, int& depth);
  bool all_connected(const Unit& unit, const StToken& name, const std::vector<Argument>& given,
                     const std::set<const Variable*>& connected, std::size_t number);
  void input_of(const TypedExpression& instance, const Argument& argument, BlockCall& call);
  int in_out_store(const Type& type, const Variable& pin, const TypedExpression& value, int place);
  int output_store(const Type& owner, const Variable& pin, const Argument& argument, int place);
  static std::vector<std::string> pins_of(const Type& type, bool output);
};

/// Cells of all variables, 8 MB: far above what such controllers have.
inline constexpr int most_cells = 1'000'000;

/// What the declarations of a unit say: its variables, its type, their initial values.
class Declarations : public Expressions {
 public:
  using Expressions::Expressions;

 protected:
  void declare(Unit& unit) override;
  std::optional<TypedExpression> later_constant(const StToken& name) override;
  /// A type of one cell, to be filled; `composed`: of its members, none so far.
  Type& new_type(Basic basic, std::string name, bool composed = false);
  /// The constant that is next, as a value of the type; `takes` tells which constants may be there.
  Cell constant_value(const Type& wanted, const char* what = "a value that is not constant",
                      const char* remedy = "use literals, constants and functions of them",
                      bool (*takes)(Basic) = is_elementary);

  /// Of what the text names by addresses only, from token `first` on.
  void declare_addresses(std::size_t first);

  std::vector<int> located_in_;  ///< the POU of each variable at a terminal, -1: VAR_GLOBAL
  std::vector<int> memory_in_;   ///< the same of those in memory

 private:
  /// AT: terminals from one on, or a place in memory.
  struct Location {
    std::optional<Address> terminal;
    int width = 1;  ///< so many of them
    std::optional<MemoryPlace> memory;
  };
  // declarations.cpp: VAR sections.
  struct VarSection {
    VarClass section = VarClass::local;
    bool constant = false;
    bool retain = false;
    bool external = false;
    bool global = false;
  };
  void declare_pou(Unit& unit);
  void declare_function_result(Unit& unit, Type& type);
  // methods.cpp
  void declare_base(Unit& unit, Type& type);
  void declare_interface(Unit& unit);
  void declare_property(Unit& unit, Type& type);
  bool variable_section(Unit& unit, Type& owner);
  std::optional<VarSection> section_header();
  void declare_variables(Unit& unit, Type& owner, const VarSection& section);
  void declare_named(Unit& unit, Type& owner, const VarSection& section, const std::vector<StToken>& names);
  void add_variable(Unit& unit, Type& owner, const VarSection& section, const StToken& name, const Type* type,
                    const Location& location, std::span<const Cell> initial);
  bool check_section(const Unit& unit, const VarSection& section, const StToken& name, const Type& type,
                     const Location& location);
  std::optional<bool> edge(const Unit& unit, const VarSection& section, const Type& type);
  void add_edge(Unit& unit, Type& owner, const StToken& name, bool rising);
  void external(const StToken& name, const Type* type);
  // places.cpp
  Location location();
  bool check_location(const Unit& unit, const VarSection& section, const StToken& name, const Type& type,
                      const Location& located);
  bool check_memory(const StToken& name, const Type& type, const MemoryPlace& place);
  void keep_at_place(const Type& owner, const StToken& name, const Type& type, const Location& located,
                     int pou);
  void keep_in_memory(const StToken& name, const Type& type, const MemoryPlace& place, int pou);
  void declare_address(const StToken& token, const std::string& name, const Location& place);
  bool name_is_free(const Unit& unit, const Type& owner, const StToken& name);

  // type_declarations.cpp
  void declare_type(Unit& unit);
  void declare_structure(Type& type);
  void initial_of(Type& type);
  [[nodiscard]] bool at_based_enumeration() const;
  void declare_enumeration(Type& type);
  const Type* parse_type();
  const Type* array_type();
  const Type* open_array_type();
  void refuse_open(const Type& type, Place place);
  const Type* string_type();
  const Type* subrange(const Type& base);
  const Type* named_type();
  const Type* reference_type();
  const Type* cam_ref();
  const Type* motion_type(const BlockType& block);
  /// Gives up what grows beyond all bounds.
  void check_size(Place place, int cells, int depth);

  // initial_values.cpp
  std::vector<Cell> initial_value(const Type& type);
  void initial_into(const Type& type, std::span<Cell> cells);
  void initial_array(const Type& type, std::span<Cell> cells);
  void initial_members(const Type& type, std::span<Cell> cells);
  Cell initial_reference(const Type& type);
  std::int64_t constant_integer(std::string_view what, const Type* wanted = nullptr);

  /// Where a unit's constants are declared, by name in lower case.
  struct LaterConstant {
    std::size_t at = 0;  ///< the ':'
    bool open = false;   ///< it is being read
    std::optional<TypedExpression> value;
  };
  using LaterConstants = std::unordered_map<std::string, LaterConstant>;
  [[nodiscard]] LaterConstants constants_of(const Unit& unit) const;
  std::unordered_map<const Unit*, LaterConstants> later_constants_;
  int later_ = 0;  ///< of them that are being read

  std::map<const BlockType*, const Type*> motions_;
  std::map<Address, std::string> terminals_;
  std::vector<std::unique_ptr<std::string>> address_names_;  ///< that tokens point to
  struct Occupied {
    std::int64_t first;
    std::int64_t end;
    bool bits;
    std::string name;
  };
  std::vector<Occupied> occupied_;               ///< addresses that variables AT %M take
  int in_members_ = 0;                           ///< of initial values
  std::optional<Variable::RefersTo> refers_to_;  ///< of the initial value that has been read
  std::int64_t type_cells_ = 0;                  ///< of all initial values
};

/// Puts a variable behind those that its owner has.
void append(Type& owner, Variable variable, std::span<const Cell> initial);
/// Everything has a place: arrays of what has none would have no end.
void fill_empty(Type& type);

/// The statements of bodies. One that cannot be understood is given up at its end, so that one run tells all
/// faults.
class Statements : public Declarations {
 public:
  using Declarations::Declarations;

 protected:
  void compile_body(Unit& unit);

 private:
  /// By their lower ends: the upper one and where it stands.
  using Labels = std::map<std::int64_t, std::pair<std::int64_t, Place>>;
  int statements(std::initializer_list<std::string_view> closing);
  int statements_until(const std::function<bool()>& closes);
  bool read_as_closer();
  int statement();
  int assignment_or_call();
  int call_statement(const Tree& call);
  int if_statement();
  int case_statement();
  void find_edges(const Unit& unit, std::vector<int>& all);
  std::int64_t case_label(const Type& selector);
  std::vector<Subrange> case_labels(const Type& selector, Labels& labels);
  [[nodiscard]] bool at_label() const;
  int condition(std::string_view closing);
  void close(const StToken& opened, std::string_view closing);

  // loops.cpp
  int for_statement();
  int while_statement();
  int repeat_statement();
  void note_endless(const TypedExpression& counter, const TypedExpression& from, const TypedExpression& to,
                    const TypedExpression& step);
  int loop_body(std::initializer_list<std::string_view> closing);
  int jump(StOp op);

  int loops_ = 0;
};

/// Reads the files of a program: their units, then all declarations, then all bodies. It stands on layers,
/// each of which knows those below it only: Reader (tokens and problems), Parser (trees), Values (constants,
/// conversions, nodes), Expressions (names and calls), Declarations, Statements.
class Compiler : public Statements {
 public:
  /// One file at least; they are needed until it has run.
  Compiler(std::span<const SourceFile> files, const CompileOptions& options, Problems& problems);
  std::shared_ptr<const Compiled> run();

 private:
  // units.cpp: the parts of the file.
  void find_units(bool standard);
  // find_methods.cpp
  void read_modifiers(Unit& unit);
  void read_header(Unit& unit);
  std::size_t end_of_method(std::size_t first, std::size_t unit_end);
  void find_methods(Unit& unit);
  void find_method_text(Unit& owner, std::size_t first, std::size_t end);
  void find_property(Unit& owner, std::size_t first, std::size_t end);
  void add_method(Unit& owner, Unit method, std::string_view mark);
  void find_bases();
  // check_methods.cpp
  void check_methods();
  void check_lacks(Unit& unit, const Unit& of, Place place);
  void check_override(const Unit& method, const Unit& base);
  void fill_method_table();
  void compile_bodies();
  void find_types();
  std::size_t find_type(std::size_t first);
  void add_globals();
  void add_unit(Unit unit);
  std::size_t end_of_unit(std::size_t opening, std::string_view closing);
  void place_in_files();
  void check_programs();
  // assertions.cpp
  [[nodiscard]] bool has_tests() const;
  void find_tests();
  void doubt_tests();
  void check_calls();
  void check_depth();
  void tell_recursion(const Unit& called, const Unit& caller);

  // configuration.cpp
  void find_configuration();
  void read_configuration();
  void configuration_part(bool tasks, int& resources);
  void declare_task();
  void declare_instance();
  void add_instance(const StToken& name, int task, Unit& unit, std::size_t connections);
  void check_instances();
  void connect_instances();

  // doubts.cpp
  struct NameUse;
  struct AxisPair {
    Place place;
    std::string master;
    std::string slave;
  };
  void find_doubts();
  [[nodiscard]] NameUse use_of(const Variable& variable, const Unit& unit) const;
  [[nodiscard]] bool goes_out(std::size_t at, const Unit& unit) const;
  [[nodiscard]] bool is_initialised(const Variable& variable) const;
  void doubt_variable(const Variable& variable, const Type& owner, const NameUse& use);
  [[nodiscard]] std::vector<AxisPair> axis_pairs(const Unit& unit, std::string_view block) const;
  void doubt_selections(const Unit& unit);

  // layout.cpp
  void place_memory();
  void place_located();
  void place_in_memory();
  void finish();
  void find_kinds();
  void mark_kinds(const Type& type, int cell);
  void walk(const Type& type, int cell, const std::string& prefix, bool retain, bool shown);
  void walk_value(const Type& type, int cell, const std::string& name, bool retain, bool shown,
                  bool writable);

  /// What a CONFIGURATION connects to a program, beside Compiled::instances.
  struct Connections {
    Unit* unit = nullptr;
    StToken name;
    std::size_t connections = 0;  ///< where the '(' is, or 0
  };
  CompileOptions options_;
  std::vector<Connections> connections_;
  std::size_t configuration_first_ = 0;
  std::size_t configuration_end_ = 0;
  std::size_t user_tokens_ = 0;  ///< where the file begins, behind the standard blocks
  Unit outside_;                 ///< sees VAR_GLOBAL only: the CONFIGURATION
};

}  // namespace drycut::devices::plcopen::st
