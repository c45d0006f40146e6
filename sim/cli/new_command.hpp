#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace drycut::sim::cli {

/// A line to start from: a file scenes/new/MACHINE_CONTROLLER.yaml, which is built into the program.
struct Start {
  std::string machine;     ///< "rotary_knife"
  std::string controller;  ///< as scenarios write it: "plcopen"
  std::string about;       ///< its first sentence
};
/// By machine, then controller.
std::vector<Start> starts();

struct NewOptions {
  std::filesystem::path folder;
  std::string machine;
  std::string controller;  ///< "" = the machine's only one
  bool list = false;
};
/// drycut new
int make_line(const NewOptions& options);

}  // namespace drycut::sim::cli
