#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "devices/device.hpp"

// What the tests of a device must show, by name. A bench (bench.hpp) says it of the states and values that a
// test looks at and of the commands that it sees taken or refused; a test says covers({"toll", "sector 150"})
// of the rest, beside the expectations that would fail if the thing did not work. The device's coverage test
// runs them all and asks for every name. A name counts only when its line was reached in a test that passed.
namespace drycut::devices::coverage {

using Marks = std::set<std::string>;

/// Adds the names of a device's table: variables and states as it spells them, "START accepted" and "START
/// refused" for the commands.
inline void add_table(const DeviceType& type, Marks& marks) {
  for (const DeviceVariable& variable : type.variables) marks.emplace(variable.name);
  for (const State& state : type.states) marks.emplace(state.name);
  for (const DeviceCommand& command : type.commands) {
    marks.insert(std::string(command.name) + " accepted");
    marks.insert(std::string(command.name) + " refused");
  }
}

/// Says that the running test shows this thing.
inline void show(const std::string& name) {
  if (std::getenv("DRYCUT_COVERS") != nullptr) std::printf("[  COVERS  ] %s\n", name.c_str());
}

/// The same of several; a name that is not `known` fails the test.
inline void cover(const Marks& known, std::initializer_list<std::string> names) {
  for (const std::string& name : names) {
    if (!known.contains(name)) ADD_FAILURE() << "no such thing to cover: " << name;
    show(name);
  }
}

/// What the passed tests of `output`, a test program's own, have covered.
inline Marks marks_of(std::FILE* output) {
  Marks covered;
  Marks marks;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), output) != nullptr) {
    std::string line = buffer.data();
    while (!line.empty() && line.back() == '\n') line.pop_back();
    constexpr std::string_view tag = "[  COVERS  ] ";
    if (line.starts_with("[ RUN      ] ")) marks.clear();
    if (line.starts_with(tag)) marks.insert(line.substr(tag.size()));
    if (line.starts_with("[       OK ] ")) covered.merge(marks);
  }
  return covered;
}

/// Runs, in one process, those of this program's tests that `filter` names, and gives what is `known` and
/// none of them covers.
inline std::vector<std::string> missing(const Marks& known, const std::string& filter) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = "DRYCUT_COVERS=1 env -u GTEST_TOTAL_SHARDS -u GTEST_SHARD_INDEX '" + program +
                              "' --gtest_color=no --gtest_filter='" + filter + "'";
  std::FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) return {"the tests do not run"};
  const Marks covered = marks_of(output);
  pclose(output);
  std::vector<std::string> names;
  for (const std::string& mark : known)
    if (!covered.contains(mark)) names.push_back(mark);
  return names;
}

}  // namespace drycut::devices::coverage
