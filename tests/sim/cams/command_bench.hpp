#pragma once
#include <filesystem>
#include <string>

#include "sim/cli/cam_command.hpp"
#include "sim/cli/check_command.hpp"
#include "tests/sim/command_bench.hpp"

namespace drycut::sim::cams {

/// A test of drycut cam, and of drycut check with cam tables, in a folder of its own.
struct CamCommandTest : CommandTest {
  std::filesystem::path file(const std::string& text, const std::string& name = "cam.csv") const {
    return test_folder.file(name, text);
  }
  static cli::CamOptions options(const std::filesystem::path& table) {
    cli::CamOptions made;
    made.table = table;
    return made;
  }
  /// The table is this text.
  cli::CamOptions options_of(const std::string& text) const { return options(file(text)); }
  int run(const cli::CamOptions& options) {
    return captured([&] { return cli::validate_cam(options); });
  }
  int check(const std::filesystem::path& file) {
    return captured([&] { return cli::check_files({{file}}); });
  }

  TestFolder test_folder;
  const std::filesystem::path& folder = test_folder.path;
};

}  // namespace drycut::sim::cams
