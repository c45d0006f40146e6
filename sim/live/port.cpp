#include "sim/live/port.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <stdexcept>

namespace drycut::sim::live {

namespace asio = boost::asio;

namespace {

std::string remedy_for(const boost::system::error_code& error, const char* option) {
  if (error == asio::error::address_in_use)
    return fmt::format("give another with {}, or {} 0 for any free one", option, option);
  if (error == asio::error::access_denied) return fmt::format("give one from 1024 on with {}", option);
  return "--listen takes an address of this machine, such as 127.0.0.1 or 0.0.0.0";
}

}  // namespace

std::uint16_t listen_at(asio::ip::tcp::acceptor& acceptor, const std::string& address, std::uint16_t port,
                        const char* for_whom, const char* option) {
  try {
    const asio::ip::tcp::endpoint endpoint(asio::ip::make_address(address), port);
    acceptor.open(endpoint.protocol());
    fcntl(acceptor.native_handle(), F_SETFD, FD_CLOEXEC);
    acceptor.set_option(asio::socket_base::reuse_address(true));
    acceptor.bind(endpoint);
    acceptor.listen();
    return acceptor.local_endpoint().port();
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error(fmt::format("cannot listen{} on {} port {}: {}; {}", for_whom, address, port,
                                         error.code().message(), remedy_for(error.code(), option)));
  }
}

}  // namespace drycut::sim::live
