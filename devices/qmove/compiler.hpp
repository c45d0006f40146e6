#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "devices/qmove/lexer.hpp"
#include "devices/qmove/program.hpp"

namespace drycut::devices::qmove {

/// Compiles one module line by line, by recursive descent, straight into code. A syntax fault gives up its
/// line, an unknown name does not. Used by compile_module.
class QclCompiler : public TokenReader<QclToken> {
 public:
  QclCompiler(const std::string& file, const Configuration& configuration,
              std::span<const CatalogueEntry> catalogue, Problems& problems);
  QclProgram compile(std::string_view text, bool tests);

 private:
  enum class Type : std::uint8_t { integer, real };

  // The present line (compiler.cpp).
  bool expect(std::string_view sign, const std::string& remedy);
  void end_of_statement();
  void syntax_error(Code code, const QclToken& at, std::string what, std::string remedy);
  static std::string found(const QclToken& token);

  // Statements (statements.cpp).
  void statement();
  void assertion();
  void word_statement();
  const NamedThing* assignment();
  void store(const NamedThing& thing, Type type);
  void note_fraction(Type type, int begin, const QclToken& name);
  void note_range(const DeviceType& type, Symbol symbol, Type of_value, int begin, const QclToken& name);
  bool other_closer();
  void note_wrapping(const NamedThing& thing, Type type, int begin, const QclToken& name);
  void check_assignable(const NamedThing& thing, const QclToken& name);
  void check_writable(int device, Symbol symbol, const QclToken& parameter);
  void label();
  void wait();
  void end();
  void set_output(bool on);
  void device_command();
  void unknown_statement();
  /// What QCL has for a word of other languages, "" for none: INC, MOD, ABS.
  static std::string_view instead_of(std::string_view word);
  const QclToken* name_operand(const std::string& form);

  // Blocks (blocks.cpp).
  struct Block {
    enum class Kind : std::uint8_t { if_, else_, while_, for_, sub };
    Kind kind = Kind::if_;
    Place place;    ///< of the IF, WHILE, FOR or SUB
    Place here;     ///< of the ELSE, else the same
    int exit = -1;  ///< the jump to the block's end (if_: to its ELSE), -1 = none
    int again = 0;  ///< where a loop goes on
  };
  struct Target {
    int code;
    Place place;
  };
  struct Reference {
    int code;
    std::string name;
    Place place;
  };
  /// Labels or subroutines: where each stands, their names as written, and who leads to them.
  struct Targets {
    std::map<std::string, Target> places;
    std::vector<std::string> names;
    std::vector<Reference> uses;
  };
  void open_condition(Block::Kind kind);
  void else_block();
  void close_block(Block::Kind kind);
  void for_block();
  /// `sound`: no problem was told of the variable.
  void for_step(const NamedThing* variable, bool sound, const std::string& form);
  void sub_block();
  std::optional<Block> close(std::string_view closing, Block::Kind kind, Block::Kind other);
  void unclosed(const Block& block);
  void aim(int code);
  void define(Targets& targets, std::string_view what, const QclToken& name);
  void refer(Targets& targets, QclOp op, const std::string& form);
  void resolve(const Targets& targets, std::string_view what, std::string_view remedy);

  // Expressions (expressions.cpp).
  Type expression(int level = 0);
  Type unary();
  Type primary();
  Type name_value();
  Type parenthesis();
  /// `left_code` and `right_code`: where the code of the two sides begins.
  void binary(std::size_t row, Type left, Type right, int left_code, int right_code, const QclToken& op);
  /// Whether the code from `begin` on gives a constant 0.
  [[nodiscard]] bool is_zero(Type type, int begin) const;
  void note_overflow(QclOp op, int left_code, int right_code, const QclToken& sign);
  /// The value of the code from `begin` to `end`, if it is of longs that are known.
  [[nodiscard]] std::optional<std::int32_t> constant(int begin, int end) const;
  void pass_arguments();
  void condition();
  void indexes(const NamedThing& thing, const QclToken& name);
  void check_index(const NamedThing& thing, std::size_t number, int begin, Place place);
  const NamedThing* find_name(const QclToken& name);
  [[nodiscard]] bool is_device(std::string_view name) const;
  std::optional<int> find_device(const QclToken& name);
  std::optional<Symbol> find_parameter(int device, const QclToken& name);
  [[nodiscard]] const DeviceType& type_of(int device) const;
  [[nodiscard]] std::vector<std::string> device_names() const;
  [[nodiscard]] std::vector<std::string> all_commands() const;

  // Code (compiler.cpp).
  int emit(QclOp op, int a = 0, int b = 0);
  [[nodiscard]] int here() const { return static_cast<int>(program_.code.size()); }
  void insert_barriers(int begin);
  void mark(int code) { marks_.insert(code); }
  int add_symbol(Symbol symbol);

  const Configuration& configuration_;
  std::span<const CatalogueEntry> catalogue_;
  SymbolTable names_;
  QclProgram program_;

  bool line_failed_ = false;
  std::set<std::string> told_names_;  ///< of the present line, that are not known, in lower case
  int nesting_ = 0;                   ///< of parentheses and signs, in the present expression
  int stack_ = 0;                     ///< cells on the stack at this point of the code
  std::set<int> marks_;               ///< code at which statements begin
  std::set<int> devices_read_;        ///< by the present statement: it waits for their samples

  std::vector<Block> blocks_;
  Targets labels_;
  Targets subs_;
  bool ended_ = false;
  Place last_ = {1, 1};
};

}  // namespace drycut::devices::qmove
