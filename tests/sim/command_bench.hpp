#pragma once
#include <gmock/gmock.h>
#include <sys/types.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/cli/commands.hpp"
#include "tests/test_folder.hpp"

namespace drycut::sim {

/// The cams that come with the program.
inline const std::filesystem::path shipped_cams = std::filesystem::path(DRYCUT_SOURCE_DIR) / "scenes/cams";

/// A test of a command: what the command last printed.
struct CommandTest : testing::Test {
  int captured(const std::function<int()>& command) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = command();
    out = testing::internal::GetCapturedStdout();
    err = testing::internal::GetCapturedStderr();
    return status;
  }

  std::string out;
  std::string err;
};

/// Starts a program that goes on beside the test; the child's number.
inline pid_t started(const std::string& program, const std::vector<std::string>& words) {
  std::vector<char*> arguments = {const_cast<char*>(program.c_str())};
  arguments.reserve(words.size() + 2);
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGINT, SIG_DFL);  // whoever runs the tests in the background has it ignored
    execv(program.c_str(), arguments.data());
    _exit(127);
  }
  return child;
}

/// What `drycut devices NAME` prints.
inline std::string printed(const std::string& name, bool json) {
  testing::internal::CaptureStdout();
  EXPECT_EQ(cli::list_devices(name, json), cli::all_passed);
  return testing::internal::GetCapturedStdout();
}

}  // namespace drycut::sim
