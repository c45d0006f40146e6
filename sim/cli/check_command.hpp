#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/commands.hpp"

namespace drycut::sim::cli {

struct CheckOptions {
  std::vector<std::filesystem::path> files;
  bool expand = false;
  bool schema = false;                ///< print the JSON Schema of scenarios and check nothing
  bool strict = false;                ///< warnings and notes fail it, too
  std::vector<std::string> set = {};  ///< overrides of the scenarios: path=value
  std::string annotate = {};          ///< whom problems are told too: "github", "gitlab", "" = nobody
};
/// drycut check: scenarios (.yaml), configurations (.cnf), QCL modules (.mod, .qcl; against the .cnf before
/// them), instruction lists (.il), cam tables and registers (.csv)
int check_files(const CheckOptions& options);

}  // namespace drycut::sim::cli
