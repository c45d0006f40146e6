#include "sim/fmi/foreign/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

// The program of host/, which the build puts into this library: whoever has it, the program, Python, a
// program of one's own, needs to find no file.
extern "C" const char drycut_fmu_host_begin[];
extern "C" const char drycut_fmu_host_end[];

namespace drycut::sim::fmi {

namespace fs = std::filesystem;

namespace {

constexpr int line_of_child = 3;
constexpr std::size_t largest_answer = std::size_t{1} << 30U;

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr std::string_view host_name = "host";

class SpawnActions {
 public:
  SpawnActions() {
    posix_spawn_file_actions_init(&files_);
    posix_spawnattr_init(&attributes_);
  }
  ~SpawnActions() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  // A group of its own: an interrupt is for the run, which ends the process then.
  int spawn(pid_t& process, const fs::path& program, const fs::path& folder, int line) {
    posix_spawn_file_actions_adddup2(&files_, line, line_of_child);
    for (const int standard : {0, 1, 2})
      posix_spawn_file_actions_addopen(&files_, standard, "/dev/null", standard == 0 ? O_RDONLY : O_WRONLY,
                                       0);
    posix_spawn_file_actions_addclosefrom_np(&files_, line_of_child + 1);
    posix_spawn_file_actions_addchdir_np(&files_, folder.c_str());
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    std::string name = "drycut-fmu";
    std::array<char*, 2> arguments = {name.data(), nullptr};
    std::array<char*, 1> environment = {nullptr};
    return posix_spawn(&process, program.c_str(), &files_, &attributes_, arguments.data(),
                       environment.data());
  }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

void write_host(const fs::path& folder) {
  const auto program = folder / host_name;
  const int file = open(program.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0700);
  const auto size = static_cast<std::size_t>(drycut_fmu_host_end - drycut_fmu_host_begin);
  const bool written = file >= 0 && write(file, drycut_fmu_host_begin, size) == static_cast<ssize_t>(size);
  if (file >= 0) close(file);
  if (!written) throw std::runtime_error(fmt::format("cannot write {}", program.string()));
}

GuestProcess::GuestProcess(std::shared_ptr<const OwnFolder> unpacked, std::string name,
                           const host::LoadRequest& load, double time_limit, std::span<double> outputs)
    : unpacked_(std::move(unpacked)), name_(std::move(name)), time_limit_(time_limit), memory_(load.memory) {
  auto folder = (unpacked_->path() / "work-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr)
    throw std::runtime_error(fmt::format("cannot make the folder {}", folder));
  begin(unpacked_->path() / host_name, folder);
  host::HostFrame message;
  host::each_member(load, [&](const auto& member) { message.put(member); });
  try {
    ask(host::FrameWord::load, message.bytes());
    take_outputs(outputs);
  } catch (...) {
    kill_it();
    throw;
  }
}

void GuestProcess::begin(const fs::path& program, const fs::path& folder) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw std::runtime_error(fmt::format("{}: no socket for its process: {}", name_, std::strerror(errno)));
  line_ = ends[0];
  // A process that another thread begins just now may still hold the program open for writing.
  constexpr int most_tries = 200;
  int failed = ETXTBSY;
  // A descriptor that is the very one of the child would be closed when it begins.
  const int child_end =
      ends[1] == line_of_child ? fcntl(ends[1], F_DUPFD_CLOEXEC, line_of_child + 1) : ends[1];
  for (int tries = 0; failed == ETXTBSY && tries < most_tries; ++tries) {
    if (tries > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    failed = SpawnActions().spawn(process_, program, folder, child_end);
  }
  close(ends[1]);
  if (child_end != ends[1]) close(child_end);
  if (failed == 0) return;
  close(std::exchange(line_, -1));
  process_ = -1;
  throw std::runtime_error(fmt::format("{}: its process cannot begin: {}", name_, std::strerror(failed)));
}

GuestProcess::~GuestProcess() {
  if (line_ >= 0) {
    // It may take leave, but not for long.
    constexpr int patience_ms = 1000;
    shutdown(line_, SHUT_WR);
    pollfd closed{line_, POLLIN, 0};
    static_cast<void>(poll(&closed, 1, patience_ms));
  }
  kill_it();
}

void GuestProcess::kill_it() {
  if (process_ > 0) {
    kill(-process_, SIGKILL);
    kill(process_, SIGKILL);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  process_ = -1;
  if (line_ >= 0) close(line_);
  line_ = -1;
}

void GuestProcess::ask(host::FrameWord word, std::span<const std::byte> bytes) {
  host::HostFrame message;
  message.put(host::FrameHead{word, static_cast<std::uint32_t>(bytes.size())});
  message.put_bytes(bytes);
  auto left = std::span(message.bytes());
  while (!left.empty()) {
    const auto sent = line_ < 0 ? -1 : send(line_, left.data(), left.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) tell_end();
    left = left.subspan(static_cast<std::size_t>(sent));
  }
}

void GuestProcess::read(void* to, std::size_t size, double until) {
  auto* at = static_cast<char*>(to);
  while (size > 0) {
    const auto got = line_ < 0 ? -1 : recv(line_, at, size, MSG_DONTWAIT);
    if (got > 0) {
      at += got;
      size -= static_cast<std::size_t>(got);
      continue;
    }
    if (got < 0 && errno == EINTR) continue;
    if (got == 0 || errno != EAGAIN) tell_end();
    constexpr double milliseconds = 1e3;
    const double left = (until - clock_seconds()) * milliseconds;
    pollfd readable{line_, POLLIN, 0};
    if (left <= 0 || poll(&readable, 1, static_cast<int>(left) + 1) == 0) {
      kill_it();
      throw std::runtime_error(fmt::format(
          "{} gave no answer within {:g} s, its limits.time: its process was ended", name_, time_limit_));
    }
  }
}

std::vector<std::byte> GuestProcess::answer() {
  const double until = clock_seconds() + time_limit_;
  host::FrameHead head;
  read(&head, sizeof head, until);
  if (head.size > largest_answer)
    throw std::runtime_error(fmt::format("{} answers what no FMU answers", name_));
  std::vector<std::byte> bytes(head.size);
  read(bytes.data(), bytes.size(), until);
  if (head.word != host::FrameWord::refused) return bytes;
  throw std::runtime_error(fmt::format(
      "{}: {}", name_, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())));
}

// It says nothing any more: what became of it?
void GuestProcess::tell_end() {
  int status = 0;
  bool ended = false;
  constexpr int most_looks = 200;  // it may have closed the socket and live on
  for (int looks = 0; process_ > 0 && !ended && looks < most_looks; ++looks) {
    if (looks > 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ended = waitpid(process_, &status, WNOHANG) == process_;
  }
  if (ended) kill(-std::exchange(process_, -1), SIGKILL);  // what it has left behind
  kill_it();
  const auto how = WIFSIGNALED(status)
                       ? fmt::format("crashed: {}", strsignal(WTERMSIG(status)))
                       : fmt::format("ended its process by itself, with status {}", WEXITSTATUS(status));
  throw std::runtime_error(
      fmt::format("{} {}; it may have {} MB, its limits.memory", name_, how, memory_ / 1000000));
}

void GuestProcess::take_outputs(std::span<double> outputs) {
  const auto bytes = answer();
  if (bytes.size() != outputs.size_bytes())
    throw std::runtime_error(
        fmt::format("{} answers {} bytes for {} outputs", name_, bytes.size(), outputs.size()));
  std::memcpy(outputs.data(), bytes.data(), bytes.size());
}

void GuestProcess::begin_step(double at, double size, std::span<const double> inputs) {
  host::HostFrame message;
  message.put(at);
  message.put(size);
  message.put_bytes(std::as_bytes(inputs));
  ask(host::FrameWord::step, message.bytes());
}

void GuestProcess::end_step(std::span<double> outputs) { take_outputs(outputs); }

std::vector<std::byte> GuestProcess::save() {
  ask(host::FrameWord::save, {});
  return answer();
}

void GuestProcess::restore(std::span<const std::byte> state) {
  ask(host::FrameWord::restore, state);
  static_cast<void>(answer());
}

}  // namespace drycut::sim::fmi
