#include "sim/time.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

namespace drycut::sim {

std::string seconds_text(Time time) {
  auto text = fmt::format(FMT_COMPILE("{}.{:09}"), time / second, time % second);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text += '0';
  return text;
}

}  // namespace drycut::sim
