#include "sim/live/port.hpp"

#include <fcntl.h>
#include <fmt/format.h>

namespace drycut::sim::live {

namespace asio = boost::asio;

namespace {

Problem problem_of(const boost::system::error_code& error, const std::string& what, const char* option) {
  const auto problem = [&](const char* at, std::string remedy) {
    return Problem{"live.cannot-listen"_code, at, 1, 1, what, std::move(remedy)};
  };
  if (error == asio::error::address_in_use)
    return problem(option, fmt::format("give another port, or {} 0 for any free one", option));
  if (error == asio::error::access_denied) return problem(option, "give a port from 1024 on");
  return problem("--listen", "an address of this machine, such as 127.0.0.1, or 0.0.0.0 for all of them");
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
    throw CannotListen(problem_of(
        error.code(),
        fmt::format("cannot listen{} on {} port {}: {}", for_whom, address, port, error.code().message()),
        option));
  }
}

}  // namespace drycut::sim::live
