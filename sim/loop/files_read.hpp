#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace drycut::sim::scenario {
struct Scenario;
}

namespace drycut::sim::loop {

/// The export of a recording may be larger than a program [bytes].
inline constexpr std::uintmax_t largest_export = std::uintmax_t{1} << 32U;

/// All files that a run of the scenario reads besides itself, by their names in it, with their bytes: the
/// controller's, foreign FMUs, recordings and their exports. "" of what cannot be read, which is told by
/// whoever runs it.
std::vector<std::pair<std::string, std::string>> read_files_of(const scenario::Scenario& scenario);

}  // namespace drycut::sim::loop
