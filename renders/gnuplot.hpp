#pragma once
#include <string>

namespace drycut::renders {

/// Lets gnuplot run `script` and returns what it writes to its standard output. No shell in between, no file.
/// Throws HelperFailed with gnuplot's own words if it fails, or with what to install if there is none.
std::string run_gnuplot(const std::string& script, const std::string& program = "gnuplot");

/// `text` as a string of the gnuplot language that means just these characters, on one line.
std::string gnuplot_string(const std::string& text);

}  // namespace drycut::renders
