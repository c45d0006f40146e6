#pragma once
// What the fuzz targets share. A target is one file `NAME_fuzz.cpp`: it reads bytes as one kind of input,
// runs what is sound for a moment, and stops the process where a rule is broken that must hold for any bytes.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "base/problem.hpp"
#include "devices/controller.hpp"

namespace drycut::fuzz {

/// Stops with a message that libFuzzer keeps with the input.
[[noreturn]] inline void broken(std::string_view rule) {
  std::fprintf(stderr, "broken rule: %.*s\n", static_cast<int>(rule.size()), rule.data());
  std::abort();
}

/// Every problem has a place in the text, says what is wrong and what would be right.
inline void expect_placed(const Problems& problems, std::string_view text) {
  const auto lines =
      1 + std::count(text.begin(), text.end(), '\n') + std::count(text.begin(), text.end(), '\r');
  for (const auto& problem : problems) {
    if (problem.line < 1 || problem.line > lines || problem.column < 1)
      broken("a problem stands in the text");
    if (problem.what.empty()) broken("a problem says what is wrong");
    if (problem.remedy.empty()) broken("a problem says what would be right");
  }
}

/// Runs a controller for some of its periods of 1 ms and reads all that it has to say.
inline void run(devices::Controller& controller, int periods) {
  constexpr std::int64_t millisecond = 1'000'000;
  for (std::int64_t time = 0; time < periods * millisecond; time += millisecond) {
    controller.run_devices(time);
    controller.run_tasks(time);
    for (const auto& event : controller.take_events())
      if (event.text.empty() && event.event == "error") broken("an error says what happened");
  }
  for (const auto& name : controller.names())
    if (const auto value = controller.find(name)) value->read();
}

}  // namespace drycut::fuzz

/// The body of a target: `text` is the input.
#define DRYCUT_FUZZ(text)                                                             \
  static void fuzz_one(std::string_view text);                                        \
  extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { \
    fuzz_one({reinterpret_cast<const char*>(data), size});                            \
    return 0;                                                                         \
  }                                                                                   \
  static void fuzz_one(std::string_view text)
