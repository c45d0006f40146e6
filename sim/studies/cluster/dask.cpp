// Dask: dask.py, a child process, is its client; what is said to it and what it says are lines of JSON.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "base/embedded.hpp"
#include "renders/html.hpp"
#include "renders/process.hpp"
#include "sim/interrupt.hpp"
#include "sim/studies/cluster/engine.hpp"

namespace drycut::sim::cluster {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int no_dask = 77;  // dask.py's exit status where Python has no module distributed
constexpr int look_ms = 500;
constexpr auto farewell = std::chrono::seconds(20);

/// dask.py run by one Python, with both ends of what is said.
class Client {
 public:
  Client(const std::string& python, const std::string& address) {
    const auto started = renders::start_companion(
        {python, "-c", std::string(embedded_file("dask.py")), address, own_program().string()});
    socket_ = started.socket;
    child_ = started.process;
  }
  ~Client() {
    ::shutdown(socket_, SHUT_WR);  // it cancels what runs, clears up and ends
    const auto end = Clock::now() + farewell;
    while (child_ > 0 && receive(look_ms) && Clock::now() < end) {
    }
    ::close(socket_);
    if (child_ <= 0) return;
    if (Clock::now() >= end) kill(child_, SIGKILL);
    status();
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void say(const Json& message) {
    const auto text = json_text(message) + "\n";
    for (std::size_t sent = 0; sent < text.size();) {
      const auto size = send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (size >= 0) {
        sent += static_cast<std::size_t>(size);
      } else if (errno == EINTR) {
        InterruptWatch::check();
      } else {
        throw std::runtime_error("the client of Dask has ended");
      }
    }
  }

  /// What it has said, after `look_ms` at most; nothing if it has ended.
  std::optional<std::vector<Json>> hear() {
    InterruptWatch::check();
    const bool there = receive(look_ms);
    InterruptWatch::check();
    std::vector<Json> messages;
    std::size_t begin = 0;
    for (auto end = heard_.find('\n'); end != std::string::npos; end = heard_.find('\n', begin)) {
      messages.push_back(json_from(heard_.substr(begin, end - begin)));
      begin = end + 1;
    }
    heard_.erase(0, begin);
    if (!there && messages.empty()) return {};
    return messages;
  }

  /// Its exit status, when it has ended or is about to; -1 if it never began.
  int status() {
    if (child_ <= 0) return -1;
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  /// False at its end.
  bool receive(int milliseconds) {
    pollfd waiting = {socket_, POLLIN, 0};
    if (poll(&waiting, 1, milliseconds) <= 0) return true;
    std::array<char, 65536> buffer{};
    const auto size = read(socket_, buffer.data(), buffer.size());
    if (size > 0) heard_.append(buffer.data(), static_cast<std::size_t>(size));
    return size > 0 || (size < 0 && errno == EINTR);
  }

  int socket_ = -1;
  pid_t child_ = -1;
  std::string heard_;
};

class Dask final : public Engine {
 public:
  Dask(std::unique_ptr<Client> client, int workers) : client_(std::move(client)), workers_(workers) {}

  void submit(const std::string& name, const std::string& bundle, const std::vector<Chunk>& chunks) override {
    if (name != staged_) client_->say({{"bundle", name}, {"bytes", renders::base64(bundle)}});
    staged_ = name;
    for (const auto& chunk : chunks)
      client_->say({{"chunk", chunk.number}, {"bundle", name}, {"items", chunk.items}});
  }

  std::vector<WorkNews> wait() override {
    const auto messages = client_->hear();
    if (!messages) throw std::runtime_error("the client of Dask has ended");
    std::vector<WorkNews> news;
    for (const auto& message : *messages) {
      if (message.contains("fatal")) throw std::runtime_error(message.at("fatal").get<std::string>());
      if (message.contains("workers")) workers_ = message.at("workers").get<int>();
      if (!message.contains("chunk")) continue;
      const auto chunk = message.at("chunk").get<int>();
      for (const auto& line : message.at("lines"))
        news.push_back({chunk, line.get<std::string>(), false, ""});
      if (message.contains("end")) news.push_back({chunk, "", true, message.at("end").get<std::string>()});
    }
    return news;
  }

  [[nodiscard]] int workers() const override { return std::max(1, workers_); }
  [[nodiscard]] std::size_t room() const override { return 4 * static_cast<std::size_t>(workers()); }
  [[nodiscard]] double chunk_seconds() const override { return 3; }

 private:
  InterruptWatch watch_;
  std::unique_ptr<Client> client_;
  int workers_;
  std::string staged_;
};

}  // namespace

std::shared_ptr<Engine> open_dask(const std::string& address, Problems& problems) {
  const InterruptWatch watch;
  for (const auto* python : {"python3", "/usr/bin/python3"}) {
    auto client = std::make_unique<Client>(python, address);
    for (auto messages = client->hear(); messages; messages = client->hear()) {
      for (const auto& message : *messages) {
        if (message.contains("workers"))
          return std::make_shared<Dask>(std::move(client), message.at("workers").get<int>());
        if (!message.contains("fatal")) continue;
        problems.push_back({"cluster.not-there"_code, "--on", 1, 1,
                            fmt::format("{}: {}", address, message.at("fatal").get<std::string>()),
                            "start one, such as dask-scheduler --port 8786, or mend the address"});
        return nullptr;
      }
    }
    if (const int status = client->status(); status != no_dask && status >= 0 && status != 127) {
      problems.push_back({"cluster.not-there"_code, "--on", 1, 1,
                          fmt::format("{}: Python's client of Dask ended with status {}", address, status),
                          "what it said is above"});
      return nullptr;
    }
  }
  problems.push_back({"cluster.not-there"_code, "--on", 1, 1,
                      fmt::format("{}: there is no Python with Dask here", address),
                      "apt install python3-distributed"});
  return nullptr;
}

}  // namespace drycut::sim::cluster
