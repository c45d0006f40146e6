#pragma once
#include <string>
#include <vector>

namespace drycut::sim::cli {

/// Does what a command line says, whose words follow the program's name; returns the exit status. What it
/// prints goes to standard output and standard error. Throws Interrupted.
int run_program(std::vector<std::string> words);

}  // namespace drycut::sim::cli
