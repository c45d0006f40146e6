#include "sim/cli/paint.hpp"

#include <fmt/color.h>
#include <unistd.h>

#include <cstdlib>

namespace drycut::sim::cli {

namespace {

bool is_set(const char* variable) {
  const auto* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool takes_colours() {
  static const bool takes = isatty(STDOUT_FILENO) != 0 && !is_set("NO_COLOR") && is_set("TERM") &&
                            std::getenv("TERM") != std::string_view("dumb");
  return takes;
}

}  // namespace

std::string painted(std::string_view text, Paint paint) {
  if (!takes_colours()) return std::string(text);
  return paint == Paint::good
             ? fmt::format(fmt::fg(fmt::terminal_color::green), "{}", text)
             : fmt::format(fmt::emphasis::bold | fmt::fg(fmt::terminal_color::red), "{}", text);
}

}  // namespace drycut::sim::cli
