#include "renders/text.hpp"

#include "renders/cairo_image.hpp"

namespace drycut::renders {
namespace {

bool continues(unsigned char byte) { return (byte & 0xC0U) == 0x80U; }

/// Bytes of the UTF-8 character at the start of `text`, 0 if there is none (also for overlong forms,
/// surrogates and what lies beyond Unicode).
std::size_t character_size(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t size = lead < 0x80   ? 1
                           : lead < 0xC2 ? 0
                           : lead < 0xE0 ? 2
                           : lead < 0xF0 ? 3
                           : lead < 0xF5 ? 4
                                         : 0;
  if (size == 0 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if (!continues(static_cast<unsigned char>(text[i]))) return 0;
  }
  const auto second = size > 1 ? static_cast<unsigned char>(text[1]) : 0U;
  const bool overlong = (lead == 0xE0 && second < 0xA0) || (lead == 0xF0 && second < 0x90);
  const bool surrogate = lead == 0xED && second >= 0xA0;
  const bool beyond = lead == 0xF4 && second >= 0x90;
  return overlong || surrogate || beyond ? 0 : size;
}

/// A pen that only measures.
struct TextMeasure {
  TextMeasure(double font_size, bool bold) { set_font(pen.get(), font_size, bold); }
  CairoSurface surface = cairo_surface(1, 1);
  Cairo pen = cairo_pen(surface.get());
};

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    if (size == 0) {
      line += '?';
    } else if (size == 1 && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7F)) {
      line += ' ';
    } else {
      line += text.substr(0, size);
    }
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return line;
}

void drop_last_character(std::string& text) {
  while (!text.empty() && continues(static_cast<unsigned char>(text.back()))) text.pop_back();
  if (!text.empty()) text.pop_back();
}

double text_width(const std::string& text, double font_size, bool bold) {
  const TextMeasure measure(font_size, bold);
  return text_width(measure.pen.get(), text);
}

std::string fitted_text(std::string text, double font_size, double room, bool bold) {
  const TextMeasure measure(font_size, bold);
  return fitted_text(measure.pen.get(), std::move(text), room);
}

std::vector<std::string> wrapped_text(const std::string& text, double font_size, double room,
                                      std::size_t most_lines) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (lines.size() + 1 < most_lines && text_width(text.substr(begin), font_size) > room) {
    std::size_t end = text.find(' ', begin);
    if (end == std::string::npos) break;
    for (std::size_t next = end; next != std::string::npos; next = text.find(' ', next + 1)) {
      if (text_width(text.substr(begin, next - begin), font_size) > room) break;
      end = next;
    }
    lines.push_back(fitted_text(text.substr(begin, end - begin), font_size, room));
    begin = end + 1;
  }
  lines.push_back(fitted_text(text.substr(begin), font_size, room));
  return lines;
}

}  // namespace drycut::renders
