#include "sim/live/opcua_gateway.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "base/json.hpp"
#include "base/plain_text.hpp"
#include "renders/process.hpp"
#include "sim/live/port.hpp"

namespace drycut::sim::live {

namespace fs = std::filesystem;

namespace {

constexpr int oldest_node = 18;
constexpr auto until_killed = std::chrono::seconds(5);

std::string node() { return "node"; }

void check_node(Problems& problems) {
  const auto remedy =
      fmt::format("install Node.js {} or later: apt install nodejs, or `make opcua`", oldest_node);
  try {
    const auto asked = renders::run_process({node(), "nodejs", {"--version"}});
    const auto version = asked.output.empty() ? 0 : std::atoi(asked.output.c_str() + 1);  // v20.20.2
    if (!asked.good || version < oldest_node)
      problems.push_back({"live.gateway-missing"_code, "--opcua", 1, 1,
                          fmt::format("node is too old: {}", asked.output), remedy});
  } catch (const renders::HelperFailed&) {
    problems.push_back(
        {"live.gateway-missing"_code, "--opcua", 1, 1, "there is no Node.js, which OPC UA needs", remedy});
  }
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return fmt::format("by signal {}", WTERMSIG(status));
  return fmt::format("with status {}", WEXITSTATUS(status));
}

}  // namespace

fs::path find_opcua_gateway(Problems& problems) {
  const auto program = fs::read_symlink("/proc/self/exe").parent_path();
  const std::array<fs::path, 2> folders = {program / "opcua",
                                           (program / "../share/drycut/opcua").lexically_normal()};
  fs::path found;
  for (const auto& folder : folders)
    if (found.empty() && fs::exists(folder / "gateway.mjs")) found = folder;
  check_node(problems);
  if (found.empty()) {
    problems.push_back(
        {"live.gateway-missing"_code, "--opcua", 1, 1,
         fmt::format("there is no OPC UA gateway in {} nor in {}", folders[0].string(), folders[1].string()),
         "`make opcua` puts it there"});
  } else if (!fs::exists(found / "node_modules/node-opcua-server")) {
    problems.push_back({"live.gateway-missing"_code, "--opcua", 1, 1,
                        fmt::format("the packages of the OPC UA gateway are missing in {}", found.string()),
                        "`make opcua`, or there: npm ci --omit=dev"});
  }
  return found;
}

std::uint16_t free_port(const std::string& address, std::uint16_t port) {
  boost::asio::io_context context;
  boost::asio::ip::tcp::acceptor acceptor(context);
  return listen_at(acceptor, address, port, " for OPC UA", "--opcua");
}

OpcuaGateway::OpcuaGateway(const Options& options) {
  const auto started = renders::start_companion({node(), (options.folder / "gateway.mjs").string()});
  socket_ = started.socket;
  child_ = started.process;
  if (child_ < 0) {
    ::close(socket_);
    throw std::runtime_error(fmt::format("cannot start {}: {}", node(), std::strerror(started.error)));
  }
  // Not as arguments: those are seen by everybody on this machine.
  const auto told = json_text({{"line", options.line},
                               {"address", options.address},
                               {"port", options.port},
                               {"token", options.token}}) +
                    "\n";
  if (::send(socket_, told.data(), told.size(), MSG_NOSIGNAL) < 0) kill(child_, SIGKILL);  // listen() says so
  thread_ = std::thread([this] { listen(); });
}

OpcuaGateway::~OpcuaGateway() {
  ending_ = true;
  ::shutdown(socket_, SHUT_WR);  // it says farewell to its clients and ends
  thread_.join();
  ::close(socket_);
}

// What it says is for the user. The process is ours until it has ended.
void OpcuaGateway::listen() {
  std::optional<std::chrono::steady_clock::time_point> last;
  std::array<char, 4096> buffer{};
  for (;;) {
    pollfd waiting = {socket_, POLLIN, 0};
    const int ready = poll(&waiting, 1, 200);
    if (ending_ && !last) last = std::chrono::steady_clock::now() + until_killed;
    if (last && std::chrono::steady_clock::now() >= *last) kill(child_, SIGKILL);
    if (ready <= 0) continue;
    const auto size = ::read(socket_, buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) break;
    if (ending_) continue;
    fmt::print("{}", std::string_view(buffer.data(), static_cast<std::size_t>(size)));
    std::fflush(stdout);
  }
  int status = 0;
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  if (!ending_)
    fmt::print(stderr, "drycut live: the OPC UA gateway has ended {}; the line goes on without it\n",
               how_it_ended(status));
}

}  // namespace drycut::sim::live
