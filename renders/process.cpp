#include "renders/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
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

void transmit(Descriptor& to, const std::string& script, std::size_t& sent) {
  const ssize_t size =
      send(to.get(), script.data() + sent, script.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
  if (size > 0) sent += static_cast<std::size_t>(size);
  const bool gone = size < 0 && errno != EINTR && errno != EAGAIN;
  if (gone || sent == script.size()) to.close();
}

pid_t start(const Command& command, int in, int out, int error) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, error, STDERR_FILENO);
  if (!command.directory.empty()) posix_spawn_file_actions_addchdir_np(&actions, command.directory.c_str());
  std::vector<std::string> words = {command.program};
  words.insert(words.end(), command.arguments.begin(), command.arguments.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = -1;
  const int status =
      posix_spawnp(&child, command.program.c_str(), &actions, nullptr, arguments.data(), environ);
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

}  // namespace

Finished run_process(const Command& command, const std::string& input) {
  auto [to_child, child_in] = connection();
  auto [from_child, child_out] = connection();
  auto [errors, child_error] = connection();
  const pid_t child = start(command, child_in.get(), child_out.get(), child_error.get());
  child_in.close();
  child_out.close();
  child_error.close();

  Finished finished;
  std::string words;
  std::size_t sent = 0;
  if (input.empty()) to_child.close();
  while (from_child.get() >= 0 || errors.get() >= 0) {
    std::array<pollfd, 3> waiting = {
        {{to_child.get(), POLLOUT, 0}, {from_child.get(), POLLIN, 0}, {errors.get(), POLLIN, 0}}};
    if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) break;
    if (waiting[0].revents != 0) transmit(to_child, input, sent);
    if (waiting[1].revents != 0) receive(from_child, finished.output);
    if (waiting[2].revents != 0) receive(errors, words);
  }
  to_child.close();

  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) fail(command.program + " got lost", errno);
  }
  finished.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  finished.words = in_short(words);
  return finished;
}

}  // namespace drycut::renders
