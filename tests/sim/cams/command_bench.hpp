#pragma once
#include <filesystem>
#include <string>

#include "sim/cli/cam_command.hpp"
#include "sim/cli/check_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim {

/// A test of drycut cam, and of drycut check with cam tables, in a folder of its own.
struct CamCommandTest : CommandTest {
  std::filesystem::path file(const std::string& text, const std::string& name = "cam.csv") const {
    return test_folder.file(name, text);
  }
  static CamOptions options(const std::filesystem::path& table) {
    CamOptions made;
    made.table = table;
    return made;
  }
  /// The table is this text.
  CamOptions options_of(const std::string& text) const { return options(file(text)); }
  int run(const CamOptions& options) {
    return captured([&] { return validate_cam(options); });
  }
  int check(const std::filesystem::path& file) {
    return captured([&] { return check_files({{file}}); });
  }

  TestFolder test_folder;
  const std::filesystem::path& folder = test_folder.path;
};

}  // namespace drycut::sim
