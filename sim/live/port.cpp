#include "sim/live/port.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <stdexcept>

namespace drycut::sim::live {

namespace asio = boost::asio;

std::uint16_t listen_at(asio::ip::tcp::acceptor& acceptor, const std::string& address, std::uint16_t port,
                        const char* for_whom) {
  try {
    const asio::ip::tcp::endpoint endpoint(asio::ip::make_address(address), port);
    acceptor.open(endpoint.protocol());
    fcntl(acceptor.native_handle(), F_SETFD, FD_CLOEXEC);
    acceptor.set_option(asio::socket_base::reuse_address(true));
    acceptor.bind(endpoint);
    acceptor.listen();
    return acceptor.local_endpoint().port();
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error(
        fmt::format("cannot listen{} on {} port {}: {}", for_whom, address, port, error.code().message()));
  }
}

}  // namespace drycut::sim::live
