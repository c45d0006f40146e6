#pragma once
#include <filesystem>

namespace drycut::sim::cli {

struct ImportOptions {
  std::filesystem::path file;
  std::filesystem::path out;  ///< "" = standard output alone
  bool force = false;
};
/// drycut import: what an export of a real machine seems to be, as a recording's YAML.
int import_file(const ImportOptions& options);

}  // namespace drycut::sim::cli
