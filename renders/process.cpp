#include "renders/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <stdexcept>
#include <utility>

#include "renders/text.hpp"

extern char** environ;  // NOLINT: POSIX gives the environment to hand on under this name

namespace drycut::renders {
namespace {

/// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  int get() const { return number_; }
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::runtime_error(what + ": " + std::strerror(error));
}

/// Ours and the child's end. Sockets, because a write to one whose reader died can be told not to raise
/// SIGPIPE.
std::pair<Descriptor, Descriptor> connection() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    fail("no connection to another program", errno);
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// What is left to read into `text`; closes at the end.
void receive(Descriptor& from, std::string& text) {
  std::array<char, 65536> buffer{};
  const ssize_t size = read(from.get(), buffer.data(), buffer.size());
  if (size > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(size));
  } else if (size == 0 || errno != EINTR) {
    from.close();
  }
}

/// 0, or errno of a start that failed; the first word is looked for in PATH.
int spawn(pid_t& child, std::vector<std::string> words, const posix_spawn_file_actions_t& actions,
          const posix_spawnattr_t* attributes) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return posix_spawnp(&child, words.front().c_str(), &actions, attributes, arguments.data(), environ);
}

pid_t start(const ProcessCommand& command, int out, int error) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, error, STDERR_FILENO);
  if (!command.directory.empty()) posix_spawn_file_actions_addchdir_np(&actions, command.directory.c_str());
  std::vector<std::string> words = {command.program};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  pid_t child = -1;
  const int status = spawn(child, std::move(words), actions, nullptr);
  posix_spawn_file_actions_destroy(&actions);
  if (status == ENOENT)
    throw HelperFailed(fmt::format("there is no {}; install {}", command.program, command.package));
  if (status != 0) throw HelperFailed(command.program + " does not start: " + std::strerror(status));
  return child;
}

/// A message without the echo of the command and empty lines.
std::string in_short(const std::string& words) {
  std::string kept;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find('\n', at), words.size());
    const std::string line = words.substr(at, end - at);
    at = end + 1;
    const std::size_t begin = line.find_first_not_of(" \t^");
    if (begin != std::string::npos) kept += (kept.empty() ? "" : " | ") + line.substr(begin, 300);
    if (kept.size() > 1500) break;
  }
  return one_line(kept);
}

/// Waits until `child` has ended. Returns its status as waitpid gives it.
int ended(pid_t child, const std::string& name) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail(name + " got lost", errno);
  }
  return status;
}

constexpr int without_answer = 1;
constexpr int without_memory = 3;

void limit(__rlimit_resource resource, rlim_t most) {
  rlimit both{};
  getrlimit(resource, &both);
  both.rlim_cur = std::min(both.rlim_cur, most);
  setrlimit(resource, &both);
}

/// Addresses that this process uses [bytes].
std::size_t memory_in_use() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// What the copy of this process does. It ends without what a process does at its end: files that are half
/// written and folders that are locked are still the original's.
[[noreturn]] void answer_and_end(const std::function<std::string()>& work, const Descriptor& to) noexcept {
  std::set_new_handler([] { _exit(without_memory); });
  // The original is to hear of a crash by its signal, whoever else listens for it.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(signal, SIG_DFL);
  try {
    const std::string answer = work();
    for (std::size_t sent = 0; sent < answer.size();) {
      const ssize_t size = send(to.get(), answer.data() + sent, answer.size() - sent, MSG_NOSIGNAL);
      if (size < 0 && errno != EINTR) _exit(without_answer);
      if (size > 0) sent += static_cast<std::size_t>(size);
    }
  } catch (...) {
    _exit(without_answer);
  }
  _exit(0);
}

/// Reads all that comes. Returns whether the sender ended in time and did not say too much.
bool receive_all(Descriptor& from, std::string& answer, const WorkLimits& limits) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + limits.until;
  while (from.get() >= 0 && answer.size() <= limits.answer_bytes) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd waiting = {from.get(), POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(left)) > 0) receive(from, answer);
  }
  return from.get() < 0;
}

/// Why there is no answer.
std::string fate(int status, const WorkLimits& limits) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return fmt::format("took more than {} s", limits.computing.count());
  if (WIFSIGNALED(status)) return fmt::format("crashed ({})", strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == without_memory)
    return fmt::format("took more than {} MB of memory", limits.memory_bytes >> 20U);
  return "ended without an answer";
}

}  // namespace

Finished run_process(const ProcessCommand& command) {
  auto [from_child, child_out] = connection();
  auto [errors, child_error] = connection();
  const pid_t child = start(command, child_out.get(), child_error.get());
  child_out.close();
  child_error.close();

  Finished finished;
  std::string words;
  while (from_child.get() >= 0 || errors.get() >= 0) {
    std::array<pollfd, 2> waiting = {{{from_child.get(), POLLIN, 0}, {errors.get(), POLLIN, 0}}};
    if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) break;
    if (waiting[0].revents != 0) receive(from_child, finished.output);
    if (waiting[1].revents != 0) receive(errors, words);
  }

  const int status = ended(child, command.program);
  finished.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  finished.words = in_short(words);
  return finished;
}

Companion start_companion(std::vector<std::string> words) {
  auto [ours, theirs] = connection();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, theirs.get(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, theirs.get(), STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  Companion companion;
  companion.error = spawn(companion.process, std::move(words), actions, &attributes);
  if (companion.error != 0) companion.process = -1;
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  companion.socket = ours.release();
  return companion;
}

std::string run_apart(const std::function<std::string()>& work, const WorkLimits& limits) {
  auto [from_child, to_parent] = connection();
  const std::size_t memory = memory_in_use() + limits.memory_bytes;
  const pid_t child = fork();
  if (child < 0) fail("no process to work in", errno);
  if (child == 0) {
    from_child.close();
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, static_cast<rlim_t>(limits.computing.count()));
    if constexpr (memory_is_limited) {
      limit(RLIMIT_AS, memory);
      // Last words of a library that aborts are not the user's; the sanitizers' are ours.
      if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    }
    answer_and_end(work, to_parent);
  }
  to_parent.close();
  std::string answer;
  const bool whole = receive_all(from_child, answer, limits);
  if (!whole) kill(child, SIGKILL);
  const int status = ended(child, "work in a process");
  if (!whole && answer.size() > limits.answer_bytes) throw WorkFailed("answered too much");
  if (!whole)
    throw WorkFailed(
        fmt::format("took more than {:g} s", std::chrono::duration<double>(limits.until).count()));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw WorkFailed(fate(status, limits));
  return answer;
}

}  // namespace drycut::renders
