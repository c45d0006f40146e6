#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace drycut::renders {

/// A program to run.
struct ProcessCommand {
  std::string program;                   ///< looked for in PATH
  std::string package;                   ///< that brings it, for the message where there is none
  std::vector<std::string> arguments;    ///< as they are: no shell reads them
  std::filesystem::path directory = {};  ///< where it runs, "" = here
};

/// A helper program is not there, or does not do its work: what it makes can be left out.
struct HelperFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Finished {
  bool good = false;  ///< it ended with status 0
  std::string output;
  std::string words;  ///< its messages on one line, in short
};

/// Runs a program to its end; it has nothing to read from its standard input. Throws HelperFailed if it
/// cannot be started.
Finished run_process(const ProcessCommand& command);

/// A program that runs beside this one, in a group of its own: the terminal's Ctrl-C comes to us alone.
struct Companion {
  int process = -1;  ///< -1: it could not be started
  int socket = -1;   ///< its standard input and output
  int error = 0;     ///< errno of a start that failed
};
/// Starts one; `words`: the program, looked for in PATH, and its arguments. No signal is blocked there.
/// Throws std::runtime_error if there is no socket to be had.
Companion start_companion(std::vector<std::string> words);

/// AddressSanitizer reserves terabytes of addresses: with it no limit of memory is set.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool memory_is_limited = false;
#elif defined(__has_feature)
constexpr bool memory_is_limited = !__has_feature(address_sanitizer);
#else
constexpr bool memory_is_limited = true;
#endif

/// What work in a process of its own may take.
struct WorkLimits {
  std::chrono::seconds computing;   ///< of a processor, however busy the machine is
  std::chrono::milliseconds until;  ///< from its start to its end, waiting included
  std::size_t memory_bytes;         ///< beyond what this process has
  std::size_t answer_bytes;
};

/// Work in a process of its own came to nothing. Says what became of it: "crashed (Segmentation fault)".
struct WorkFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What `work` returns when a copy of this process does it. Whatever it does there, nothing else of it is
/// seen here: a crash, an exception, too much time, memory or answer become a WorkFailed. Throws
/// std::runtime_error if there is no process to be had. `work` must not wait for other threads: the copy has
/// none.
std::string run_apart(const std::function<std::string()>& work, const WorkLimits& limits);

}  // namespace drycut::renders
