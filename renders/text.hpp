#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace drycut::renders {

/// One line of valid UTF-8: control characters become spaces, bytes that are no UTF-8 become '?'.
std::string one_line(std::string_view text);

/// Removes the last character (not byte) of a UTF-8 text.
void drop_last_character(std::string& text);

/// Width of a line in DejaVu Sans [pixels] at that font size [pixels].
double text_width(const std::string& text, double font_size, bool bold = false);

/// `text`, or its beginning and an ellipsis, no wider than `room` [pixels].
std::string fitted_text(std::string text, double font_size, double room, bool bold = false);

/// `text` in lines of whole words no wider than `room` [pixels]; the last of `most_lines`, and a word that is
/// wider, end in an ellipsis where something is left out. One line at least.
std::vector<std::string> wrapped_text(const std::string& text, double font_size, double room,
                                      std::size_t most_lines);

}  // namespace drycut::renders
