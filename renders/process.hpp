#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace drycut::renders {

/// A program to run.
struct Command {
  std::string program;                   ///< looked for in PATH
  std::string package;                   ///< that brings it, for the message where there is none
  std::vector<std::string> arguments;    ///< as they are: no shell reads them
  std::filesystem::path directory = {};  ///< where it runs, "" = here
};

/// A helper program is not there, or does not do its work: what it makes can be left out.
struct HelperFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Finished {
  bool good = false;  ///< it ended with status 0
  std::string output;
  std::string words;  ///< its messages on one line, in short
};

/// Runs a program to its end with `input` as its standard input. Throws HelperFailed if it cannot be
/// started.
Finished run_process(const Command& command, const std::string& input);

}  // namespace drycut::renders
