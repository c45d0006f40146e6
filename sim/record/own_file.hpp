#pragma once
#include <filesystem>
#include <string_view>

namespace drycut::sim::record {

/// How the first line of a text begins, behind its sign of a comment, that drycut writes under a name of the
/// user's: "# Written by drycut design: ...".
inline constexpr std::string_view own_mark = "Written by drycut";

/// Whether a file says of itself that drycut wrote it, or is empty: nobody's work is lost with it. A text
/// says so in its first line, by `own_mark` or by beginning with `header`, which no other program writes; ""
/// = there is none. A picture says so in its chunk Software, MCAP by its library, HDF5 by its attribute
/// written_by, an FMU by its generationTool. False of what cannot be read.
bool is_own_file(const std::filesystem::path& file, std::string_view header = {});

}  // namespace drycut::sim::record
