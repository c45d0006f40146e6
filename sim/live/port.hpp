#pragma once
#include <boost/asio/ip/tcp.hpp>

#include <cstdint>
#include <string>

namespace drycut::sim::live {

/// Has the acceptor listen there, at any free port if it is 0; the port. No program started from here keeps
/// it. Throws std::runtime_error, which says for whom (" for Modbus") and which `option` gives another.
std::uint16_t listen_at(boost::asio::ip::tcp::acceptor& acceptor, const std::string& address,
                        std::uint16_t port, const char* for_whom, const char* option);

}  // namespace drycut::sim::live
