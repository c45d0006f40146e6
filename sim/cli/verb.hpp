#pragma once
#include <string_view>
#include <vector>

#include "sim/cli/file_kinds.hpp"

namespace CLI {
class App;
}

namespace drycut::sim::cli {

/// A verb of the program, all of it: the command line, --help, completion, the manual, docs/reference and
/// Python are made of this row and of the options that it adds.
struct Verb {
  enum class Shown { yes, no };

  std::string_view name;
  std::string_view help;                   ///< the first phrase says what it does
  std::vector<std::string_view> examples;  ///< command lines; one goes on where the next begins with a blank
  Takes takes;
  /// Adds its options to a command; what the chosen one comes to goes to `status`.
  void (*options)(CLI::App& command, int& status) = nullptr;
  Shown shown = Shown::yes;
};

/// All of them, in the order of --help.
const std::vector<Verb>& verbs();

}  // namespace drycut::sim::cli
