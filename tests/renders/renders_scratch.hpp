#pragma once
#include <gtest/gtest.h>

#include <string>

#include "tests/test_folder.hpp"

namespace drycut::renders::testing {

using Scratch = TestFolder;

/// What `action` says when it throws an `Error`; fails the test if it does not.
template <typename Error, typename Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace drycut::renders::testing
