#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/scanner.hpp"

namespace drycut::devices::plcopen::st {

/// The pragmas of CODESYS that decide what is compiled: {define N}, {define N 'text'}, {undefine N}, {IF
/// ...}, {ELSIF ...}, {ELSE}, {END_IF}, {error 'text'}. Conditions are defined(N), hasvalue(N, 'text'), NOT,
/// AND, OR and parentheses; what asks for more is refused. Other pragmas are passed over.
class Pragmas : private Complaints {
 public:
  using Complaints::Complaints;

  /// `text` is what stands between { and }, `place` where the { is.
  void read(std::string_view text, Place place);
  /// Whether the text that follows is compiled.
  [[nodiscard]] bool active() const { return branches_.empty() || branches_.back().active; }
  /// At the end of the file.
  void finish();

 private:
  struct Branch {
    Place opened;
    bool outer = true;   ///< what surrounds it is compiled
    bool taken = false;  ///< one of its parts has been
    bool active = false;
    bool otherwise = false;  ///< {ELSE} has been
  };
  struct Condition;

  void next_part(std::string_view word, bool holds, Place place);
  void define(const std::vector<std::string>& words, Place place);
  bool condition(const std::vector<std::string>& words, std::string_view text, Place place);

  std::map<std::string, std::string> defined_;  ///< by name in lower case
  std::vector<Branch> branches_;
};

}  // namespace drycut::devices::plcopen::st
