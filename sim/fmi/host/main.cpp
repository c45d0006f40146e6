// The process that holds one foreign FMU: what it does wrong ends this process and not the run. It needs the
// C and C++ libraries only, and answers on one socket until that is closed.
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <memory>
#include <thread>

#include "sim/fmi/host/model.hpp"

namespace drycut::sim::fmi::host {

namespace {

constexpr int line = 3;                                  // the socket
constexpr std::string_view folder_name = "drycut-fmu-";  // as archive.cpp begins it

bool read_all(void* to, std::size_t size) {
  auto* at = static_cast<char*>(to);
  while (size > 0) {
    const auto got = recv(line, at, size, 0);
    if (got <= 0) return false;
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

void answer(FrameWord word, std::span<const std::byte> bytes) {
  HostFrame message;
  message.put(FrameHead{word, static_cast<std::uint32_t>(bytes.size())});
  message.put_bytes(bytes);
  auto left = std::span(message.bytes());
  while (!left.empty()) {
    const auto sent = send(line, left.data(), left.size(), MSG_NOSIGNAL);
    if (sent <= 0) _exit(0);
    left = left.subspan(static_cast<std::size_t>(sent));
  }
}

void limit(int what, std::uint64_t most) {
  const rlimit limits{most, most};
  static_cast<void>(setrlimit(static_cast<__rlimit_resource>(what), &limits));
}

// Files of its own are as large as its memory at most, and none is left of a crash.
void take_limits(const LoadRequest& load) {
  constexpr std::uint64_t open_files = 256;
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_NOFILE, open_files);
  limit(RLIMIT_FSIZE, load.memory);
  limit(RLIMIT_AS, load.memory);
}

/// The run has ended without its say: a process that it still needs is told of its end, or killed, before the
/// socket is closed.
bool is_hung_up(int wait_ms) {
  pollfd closed{line, 0, 0};
  return poll(&closed, 1, wait_ms) > 0 && (closed.revents & POLLHUP) != 0;
}

// What was unpacked for the run, this program among it.
void remove_folder() {
  std::error_code none;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  if (!folder.filename().string().starts_with(folder_name)) return;
  constexpr int most_tries = 10;  // processes of other instances remove it, too
  for (int tries = 0; tries < most_tries && std::filesystem::exists(folder, none); ++tries)
    std::filesystem::remove_all(folder, none);
}

// A run that was killed must leave neither an FMU that never answers nor its files.
void end_with_the_run() {
  std::thread([] {
    while (!is_hung_up(-1)) {
    }
    remove_folder();
    _exit(0);
  }).detach();
}

std::unique_ptr<LoadedModel> model;
std::size_t inputs = 0;

void answer_outputs() { answer(FrameWord::done, std::as_bytes(std::span(model->outputs()))); }

void do_what_is_asked(FrameWord word, HostFrame& message) {
  if (word == FrameWord::load) {
    LoadRequest load;
    each_member(load, [&](auto& member) { message.get(member); });
    take_limits(load);
    for (const auto& variable : load.inputs) inputs += variable.elements;
    model = std::make_unique<LoadedModel>(load);
    answer_outputs();
  } else if (word == FrameWord::step) {
    double at = 0;
    double size = 0;
    message.get(at);
    message.get(size);
    std::vector<double> values(inputs);
    for (auto& value : values) message.get(value);
    model->step(at, size, values);
    answer_outputs();
  } else if (word == FrameWord::save) {
    answer(FrameWord::done, model->save());
  } else if (word == FrameWord::restore) {
    model->restore(message.left());
    answer(FrameWord::done, {});
  }
}

int serve() {
  end_with_the_run();
  FrameHead head;
  while (read_all(&head, sizeof head)) {
    std::vector<std::byte> bytes(head.size);
    if (!read_all(bytes.data(), bytes.size())) break;
    HostFrame message(std::move(bytes));
    try {
      do_what_is_asked(head.word, message);
    } catch (const std::bad_alloc&) {
      constexpr std::string_view why = "there is no memory left";
      answer(FrameWord::refused, std::as_bytes(std::span(why)));
    } catch (const std::exception& error) {
      const std::string_view why = error.what();
      answer(FrameWord::refused, std::as_bytes(std::span(why)));
    }
  }
  if (is_hung_up(0)) remove_folder();
  model.reset();
  return 0;
}

}  // namespace

}  // namespace drycut::sim::fmi::host

int main() {
  std::signal(SIGPIPE, SIG_IGN);
  const int status = drycut::sim::fmi::host::serve();
  _exit(status);  // whatever the FMU has left at its end is not called
}
