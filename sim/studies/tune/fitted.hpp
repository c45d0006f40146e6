#pragma once
#include <string>
#include <vector>

#include "sim/studies/tune/parameter.hpp"

namespace drycut::sim::studies {

/// True if an option names the fit.json of a fit in place of PATH=LO..HI.
bool names_fit(std::string_view text);

/// The limits that a fit found, as ranges in the units of its rows, each with `option` and where the file is
/// named in it. Those of `given` have a range of their own beside it, which counts in their place. A file
/// that is no fit, and a value that the fit does not know, go to `problems`.
TunedParameters limits_of_fit(const std::string& file, const std::string& option,
                              const std::vector<std::string>& given, Problems& problems);

/// The paths of those `texts` that are PATH=..., as `given` above.
std::vector<std::string> given_paths(const std::vector<std::string>& texts);

}  // namespace drycut::sim::studies
