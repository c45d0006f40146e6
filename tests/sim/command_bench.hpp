#pragma once
#include <gmock/gmock.h>

#include <functional>
#include <string>

#include "tests/test_folder.hpp"

namespace drycut::sim {

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

}  // namespace drycut::sim
