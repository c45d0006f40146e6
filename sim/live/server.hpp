#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/live/line.hpp"

namespace drycut::sim::live {

/// Serves the page of a line and carries what it tells and what it is asked, over HTTP and WebSocket. Only
/// pages that it gave out itself may talk to it: Host and Origin are looked at, and where it can be reached
/// from other machines a token must be shown. A client that does not read loses news, then its connection;
/// the line never waits.
class Server {
 public:
  struct Options {
    std::string address = "127.0.0.1";
    std::uint16_t port = 8080;  ///< 0 = any free one
    std::string token;          ///< demanded as ?token=... ; "" = none
  };
  /// Where it listens is taken here. Throws CannotListen.
  Server(Options options, Line& line);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// "http://127.0.0.1:8080/"
  [[nodiscard]] std::string url() const;

  /// From any thread.
  void tell(std::shared_ptr<const News> news);
  void describe(std::shared_ptr<const LineDescription> line);
  void answer(std::vector<Answer> answers);

 private:
  struct Core;
  std::unique_ptr<Core> core_;
};

}  // namespace drycut::sim::live
