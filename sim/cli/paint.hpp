#pragma once
#include <string>
#include <string_view>

namespace drycut::sim::cli {

enum class Paint { good, bad };

/// The text in the colour of a verdict, where standard output is a terminal that takes colours and NO_COLOR
/// is not set (no-color.org); else as it is.
std::string painted(std::string_view text, Paint paint);

}  // namespace drycut::sim::cli
