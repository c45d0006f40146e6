#pragma once

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace drycut::sim::cli {

/// Tells on standard error why a command line could not be read, a line a problem: "drycut COMMAND: what is
/// wrong; what would be right".
void tell_usage(const CLI::App& app, const CLI::ParseError& error);

}  // namespace drycut::sim::cli
