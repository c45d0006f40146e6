#pragma once
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace drycut {

// Text that people read: what is wrong, what was found, a heading, a caption. The program decides nothing by
// it. A build with DRYCUT_SCRAMBLE proves that (tests/house/scrambled.py): there every such text loses its
// words where it is made, and verdicts, exit statuses, codes and columns stay.

#ifdef DRYCUT_SCRAMBLE
class Prose : public std::string {
 public:
  Prose() = default;
  Prose(std::string text) : std::string(std::move(text)) { scramble(); }
  Prose(const char* text) : std::string(text) { scramble(); }
  /// Later texts lose their words, too.
  Prose& operator+=(const std::string& more) {
    append(more);
    scramble();
    return *this;
  }

 private:
  void scramble() {
    for (char& c : *this)
      if (c != ' ' && c != '\n') c = 'x';
  }
};
#else
using Prose = std::string;
#endif

/// What kind of slip or finding it is: `room.kebab-word`. It stays the same in every release, whatever
/// becomes of the sentence beside it, and none is used again for something else. `drycut help CODE` says
/// what it means, where it comes from and what to do. A code is a row of base/problem.hpp.
class Code {
 public:
  explicit constexpr Code() = default;
  [[nodiscard]] constexpr std::string_view text() const { return text_; }
  friend constexpr bool operator==(Code code, std::string_view text) { return code.text_ == text; }
  friend constexpr bool operator==(Code a, Code b) { return a.text_ == b.text_; }

 private:
  friend struct CodeTable;
  explicit constexpr Code(std::string_view text) : text_(text) {}
  std::string_view text_ = {};
};

/// One fault of an input text. Printed as `file:line:column: what; remedy [code]`.
struct Problem {
  Code code;
  std::string file;  ///< name of the text as the user gave it
  int line = 0;      ///< 1-based
  int column = 0;    ///< 1-based
  Prose what;        ///< what is wrong
  Prose remedy;      ///< what would be right

#if __cplusplus >= 202002L
  bool operator==(const Problem&) const = default;
#endif
};

/// All faults found in one run, in the order of the text.
using Problems = std::vector<Problem>;

/// What a run tells of itself and its input though nothing was refused. Printed as `text [code]`.
struct Finding {
  enum class Role {
    cause,    ///< why checks failed, as far as the run tells
    warning,  ///< what may be a slip though the checks cannot tell
    note,
  };
  std::string code;
  Prose text;
  Role role = Role::note;

  Finding() = default;
  Finding(Code of, std::string says, Role as = Role::note)
      : code(of.text()), text(std::move(says)), role(as) {}

#if __cplusplus >= 202002L
  bool operator==(const Finding&) const = default;
#endif
  template <typename Archive, typename Self>
  static void visit(Archive& archive, Self& self) {
    archive("code", self.code);
    archive("role", self.role);
    archive("text", self.text);
  }
};

constexpr std::array<std::string_view, 3> words_of(Finding::Role) { return {"cause", "warning", "note"}; }

/// How bad an event is: nothing to do; to look at; the line does not do what it must; something broke, or may
/// have. An error or damage of a machine fails a run none of whose checks asks about it.
enum class Severity { note, warning, error, damage };

/// "note", "warning", "error", "damage".
constexpr std::string_view name_of(Severity severity) {
  constexpr std::string_view names[] = {"note", "warning", "error", "damage"};
  return names[static_cast<int>(severity)];
}

}  // namespace drycut
