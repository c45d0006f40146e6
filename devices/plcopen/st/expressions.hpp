#pragma once
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

namespace drycut::devices::plcopen::st {

/// What expressions, assignments and calls mean: names by the declarations, types by the parts; and their
/// code. `wanted` is the type that the context asks for, or nullptr.
class Expressions : public Values {
 public:
  using Values::Values;

 protected:
  Expression expression(const Type* wanted = nullptr) { return typed(tree(), wanted); }
  Expression typed(const Tree& tree, const Type* wanted = nullptr);
  std::optional<Expression> variable(const Token& name);
  [[nodiscard]] Unit* find_unit(std::string_view name) const;
  /// Reads the declarations of a unit that may be needed before its turn.
  virtual void declare(Unit& unit) = 0;

  // calls.cpp
  int assign(const Expression& target, const Expression& value);
  /// Notes a table's file that the text names.
  void cam_file(const Token& text);
  int sequence_node(std::vector<int> statements, Place place);
  /// The statements that give an instance's inputs and take its outputs.
  struct BlockCall {
    std::set<std::string> given;  ///< pins; "?" if something was given that is none
    std::vector<int> before;
    std::vector<int> after;
  };
  /// Whether what is called is a function, not an instance.
  bool names_function(const Tree& callee);
  BlockCall block_arguments(const Expression& instance, const std::vector<Argument>& given);
  int block_call(const Expression& instance, const Tree& tree);
  const Variable* pin_of(const Type& type, const Token& name, bool output);

  std::vector<std::unique_ptr<Unit>> units_;
  std::unordered_map<std::string, Unit*> unit_index_;          ///< by name in lower case, VAR_GLOBAL apart
  Type* globals_ = nullptr;                                    ///< its variables are where the memory begins
  std::unordered_map<std::string, const Type*> enumerations_;  ///< by name in lower case
  std::multimap<std::string, std::pair<const Type*, std::int64_t>> enum_values_;
  const Type* cam_ref_ = nullptr;
  std::set<std::string> told_;  ///< names that are not known, told once a POU
  int open_units_ = 0;

 private:
  // expressions.cpp
  Expression literal(const Token& token);
  Expression typed_literal(const Tree& tree);
  Expression name_expression(const Token& name, const Type* wanted);
  const Type* enumeration(std::string_view name);
  std::optional<Expression> enum_value(const Token& name, const Type* wanted);
  Expression qualified_enum(const Type& type, const Token& name);
  Expression member_of(const Tree& tree);
  Expression no_member(const Expression& owner, const Token& name);
  Expression bits_of_number(const Tree& tree, const Expression& owner);
  Expression element_of(const Tree& tree);
  Expression element_at(Expression owner, const Expression& index);
  [[nodiscard]] std::vector<std::string> known_names() const;

  // calls.cpp
  /// EN and ENO of a call; nullptr where they are not given.
  struct Enable {
    const Tree* condition = nullptr;
    const Tree* result = nullptr;
  };
  int store(const Expression& target, int value);
  Enable take_enable(std::vector<Argument>& given, const Type* callee);
  int enable_condition(const Enable& enable, Place place);
  int enable_store(const Enable& enable, bool on);
  Expression enabled(const Enable& enable, Expression value, const Type* wanted);
  Expression call(const Tree& tree, const Type* wanted);
  Expression function_call(const Token& name, const std::vector<Argument>& given, const Type* wanted);
  Expression user_call(Unit& unit, const Token& name, const std::vector<Argument>& given);
  std::vector<int> input_triple(const Type& function, const Variable& pin, const Argument& argument,
                                int frame, int& depth);
  bool all_connected(const Unit& unit, const Token& name, const std::vector<Argument>& given,
                     const std::set<const Variable*>& connected, std::size_t number);
  void input_of(const Expression& instance, const Argument& argument, BlockCall& call);
  int in_out_store(const Type& type, const Variable& pin, const Expression& value, int place);
  int output_store(const Type& owner, const Variable& pin, const Argument& argument, int place);
  static std::vector<std::string> pins_of(const Type& type, bool output);
};

}  // namespace drycut::devices::plcopen::st
