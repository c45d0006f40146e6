#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace drycut {

/// Bytes of the UTF-8 character at `at`; 0 if none begins there: no surrogate, nothing longer than it needs.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// What makes a text unfit to be read and shown, and where.
struct TextFault {
  int line = 1;
  int column = 1;    ///< [characters]
  std::string what;  ///< "byte 0xe8 is no text"
};
/// The first byte that is no UTF-8, or a control character other than tab and line ends.
std::optional<TextFault> text_fault(std::string_view text);

/// A name for a terminal, on one line: what would do something there instead of being shown is written as
/// \x1B.
std::string printable(std::string_view text);

/// A word of a command line for a shell: as it stands, or between single quotes where the shell would take it
/// apart.
std::string shell_word(std::string_view text);

}  // namespace drycut
