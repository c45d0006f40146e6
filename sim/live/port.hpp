#pragma once
#include <boost/asio/ip/tcp.hpp>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "base/problem.hpp"

namespace drycut::sim::live {

/// An address or a port that cannot be had; the problem is the option's that gives another.
struct CannotListen : std::runtime_error {
  explicit CannotListen(Problem of) : std::runtime_error(to_string(of)), problem(std::move(of)) {}
  Problem problem;
};

/// Has the acceptor listen there, at any free port if it is 0; the port. No program started from here keeps
/// it. Throws CannotListen, which says for whom (" for Modbus") and which `option` gives another.
std::uint16_t listen_at(boost::asio::ip::tcp::acceptor& acceptor, const std::string& address,
                        std::uint16_t port, const char* for_whom, const char* option);

}  // namespace drycut::sim::live
