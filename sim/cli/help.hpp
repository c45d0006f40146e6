#pragma once
#include <CLI/CLI.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace drycut::sim::cli {

// What --help, the manual page and docs/reference say of the command line, from the program's own options.

/// "--jobs N", "scenarios".
std::string spelling(const CLI::Option& option);
/// "drycut run scenarios... [options]"
std::string synopsis(const CLI::App& command);
/// " (default: out)", "" = none.
std::string default_of(const CLI::Option& option);

/// Command lines to begin with.
std::vector<std::string_view> examples_of(std::string_view command);

struct StatusText {
  std::string_view status;
  std::string_view meaning;
};
/// Of every command, unless its description says otherwise.
const std::vector<StatusText>& exit_statuses();

/// Writes --help, in lines of 80 characters.
class HelpPage : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

/// What it was made from and with: "drycut 0.1.0", commit, compiler, libraries, a line each.
std::string version_text();

}  // namespace drycut::sim::cli
