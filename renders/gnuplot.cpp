#include "renders/gnuplot.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "renders/process.hpp"
#include "renders/text.hpp"

namespace drycut::renders {

std::string run_gnuplot(const std::string& script, const std::string& program) {
  // Default settings, not ~/.gnuplot: the same picture for every user.
  const Command command = {program, "gnuplot-nox", {"--default-settings"}};
  const Finished finished = [&] {
    try {
      return run_process(command, script);
    } catch (const HelperFailed& error) {
      throw HelperFailed(std::string("plots: ") + error.what());
    }
  }();
  if (!finished.good) throw HelperFailed("plots: gnuplot failed: " + finished.words);
  if (finished.output.rfind("\x89PNG", 0) != 0) {
    throw HelperFailed("plots: gnuplot drew nothing: " + finished.words);
  }
  return finished.output;
}

std::string gnuplot_string(const std::string& text) {
  // Every sign that could mean something to gnuplot (quotes, backslash, backticks, macros) as an octal
  // escape, which it reads when all substitutions are over. It takes as many digits as it finds, so that a
  // digit after an escape must be one as well.
  constexpr std::string_view kPlain = " .,:;+-*/=()[]_<>|";
  std::string quoted = "\"";
  bool escaped = false;
  for (const char c : one_line(text)) {
    const bool digit = c >= '0' && c <= '9';
    const bool letter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    escaped = !(letter || kPlain.find(c) != std::string_view::npos || (digit && !escaped));
    quoted += escaped ? fmt::format("\\{:03o}", static_cast<unsigned>(c)) : std::string(1, c);
  }
  return quoted + "\"";
}

}  // namespace drycut::renders
