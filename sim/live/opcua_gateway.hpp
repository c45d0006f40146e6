#pragma once
#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>

#include "base/problem.hpp"

namespace drycut::sim::live {

/// The folder of the OPC UA gateway with its packages: beside the program that was built, or in
/// share/drycut of the one that was installed. "" after a problem, which says what has to be done.
std::filesystem::path find_opcua_gateway(Problems& problems);

/// A port that can be listened on: `port` itself, or any free one for 0. Throws std::runtime_error if it
/// cannot be had.
std::uint16_t free_port(const std::string& address, std::uint16_t port);

/// The OPC UA gateway, a process of its own (opcua/gateway.mjs, run by Node.js), which talks to the line as a
/// page does. It ends with this object, and by itself when this process has ended. When it ends before, that
/// is said and the line goes on.
class OpcuaGateway {
 public:
  struct Options {
    std::filesystem::path folder;  ///< of gateway.mjs
    std::string line;              ///< the address of its page, with the token if it has one
    std::string address;           ///< where it listens
    std::uint16_t port = 4840;     ///< not 0
    std::string token;             ///< the password of user drycut; "" = anonymous
  };
  /// Starts it. Where it listens is said on standard output as soon as it does. Throws std::runtime_error if
  /// it cannot be started.
  explicit OpcuaGateway(const Options& options);
  ~OpcuaGateway();
  OpcuaGateway(const OpcuaGateway&) = delete;
  OpcuaGateway& operator=(const OpcuaGateway&) = delete;

 private:
  void listen();

  int socket_ = -1;
  pid_t child_ = -1;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace drycut::sim::live
