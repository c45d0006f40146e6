#pragma once
#include <CLI/App.hpp>
#include <filesystem>

namespace drycut::sim {

/// drycut reference DIR: what the tables of the program say, as files: `drycut.1`, the manual page;
/// `drycut.bash`, completion for bash; `commands.md`, `devices.md`, `plants.md` and a page of Markdown for
/// each of devices and plants. Returns an exit status.
int write_reference(const CLI::App& program, const std::filesystem::path& folder);

}  // namespace drycut::sim
