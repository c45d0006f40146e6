// A live line's port: HTTP, frames of a WebSocket, messages in sound frames. Whatever comes, the connection
// ends with its client, and the line still answers the next one.
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "sim/live/line.hpp"
#include "sim/live/server.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace drycut {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace live = sim::live;
using tcp = asio::ip::tcp;

constexpr auto* scenario = R"(scene: {title: A web, step: 1 ms, duration: 2 s}
plants:
  web: {type: web, speed: 60 m/min, wheel: {lines: 1000}}
checks: [{name: slow enough, always: web.speed <= 62 m/min}]
)";

/// The alarm with which libFuzzer watches for what takes too long interrupts calls: those are made again.
auto undisturbed(auto call) {
  for (;;) {
    try {
      return call();
    } catch (const boost::system::system_error& error) {
      if (error.code() != asio::error::interrupted) throw;
    }
  }
}

/// A line that stands at time zero, and its server; for the whole process.
class Stand {
 public:
  Stand() {
    std::string folder = (std::filesystem::temp_directory_path() / "drycut-fuzz-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) fuzz::broken("there is a folder for the scenario");
    const auto file = std::filesystem::path(folder) / "web.yaml";
    std::ofstream(file) << scenario;
    Problems problems;
    line_ = std::make_unique<live::Line>(live::Line::Options{.scenario = file, .running = false}, problems);
    if (!problems.empty()) fuzz::broken(to_string(problems.front()));
    server_ = std::make_unique<live::Server>(live::Server::Options{"127.0.0.1", 0, ""}, *line_);
    thread_ = std::thread([this] {
      line_->run({[this](auto news) { server_->tell(std::move(news)); },
                  [this](auto told) { server_->describe(std::move(told)); },
                  [this](auto answers) { server_->answer(std::move(answers)); }});
    });
    host = "127.0.0.1:" + std::to_string(server_->port());
  }
  ~Stand() {
    line_->stop();
    thread_.join();
  }
  Stand(const Stand&) = delete;
  Stand& operator=(const Stand&) = delete;

  tcp::socket connect() {
    return undisturbed([this] {
      tcp::socket socket(context_);
      socket.connect({asio::ip::make_address("127.0.0.1"), server_->port()});
      return socket;
    });
  }
  /// Stands still, whatever it was asked.
  void rest() { line_->ask({0, live::Go{false}}); }
  /// A client that behaves gets its answer.
  void expect_alive() {
    undisturbed([this] {
      beast::websocket::stream<tcp::socket> socket(connect());
      socket.handshake(host, "/ws");
      socket.write(asio::buffer(std::string_view(R"({"run": false, "id": 7})")));
      for (;;) {
        beast::flat_buffer buffer;
        socket.read(buffer);
        if (beast::buffers_to_string(buffer.data()).starts_with(R"({"done":7)")) return;
      }
    });
  }

  std::string host;

 private:
  asio::io_context context_;
  std::unique_ptr<live::Line> line_;
  std::unique_ptr<live::Server> server_;
  std::thread thread_;
};

/// A client's frame of text, masked with zeros.
std::string frame(std::string_view text) {
  std::string bytes = "\x81";
  constexpr std::size_t short_text = 125;
  if (text.size() <= short_text) {
    bytes += static_cast<char>(0x80U | text.size());
  } else {
    bytes += '\xfe';
    bytes += static_cast<char>(text.size() >> 8U);
    bytes += static_cast<char>(text.size() & 0xffU);
  }
  bytes.append(4, '\0');
  bytes += text;
  return bytes;
}

/// What goes over the wire: "h" and a request of HTTP, in which $HOST is the server's; "f" and what follows
/// the handshake of a WebSocket; else messages, one a line.
std::string wire(std::string_view text, const std::string& host) {
  if (text.starts_with('h')) {
    std::string request(text.substr(1));
    constexpr std::string_view name = "$HOST";
    if (const auto at = request.find(name); at != std::string::npos) request.replace(at, name.size(), host);
    return request;
  }
  std::string bytes = "GET /ws HTTP/1.1\r\nHost: " + host +
                      "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
  if (text.starts_with('f')) return bytes.append(text.substr(1));
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    bytes += frame(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return bytes;
}

}  // namespace

DRYCUT_FUZZ(text) {
  constexpr std::size_t most = 4096;  // a megabyte of restarts takes its time
  if (text.size() > most) return;
  static Stand stand;
  auto socket = stand.connect();
  const timeval patience{10, 0};
  setsockopt(socket.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  beast::error_code error;
  asio::write(socket, asio::buffer(wire(text, stand.host)), error);
  socket.shutdown(tcp::socket::shutdown_send, error);
  char answer[4096];
  ssize_t got = 0;
  do got = ::recv(socket.native_handle(), answer, sizeof answer, 0);
  while (got > 0 || (got < 0 && errno == EINTR));
  if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) fuzz::broken("a connection ends with its client");
  stand.rest();
  constexpr int now_and_then = 16;
  static int runs = 0;
  if (++runs % now_and_then == 0) stand.expect_alive();
}

}  // namespace drycut
