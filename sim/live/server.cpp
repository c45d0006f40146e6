#include "sim/live/server.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include <algorithm>
#include <chrono>
#include <deque>
#include <list>
#include <map>
#include <mutex>
#include <thread>

#include "sim/live/port.hpp"
#include "sim/live/protocol.hpp"
#include "sim/live/site.hpp"

namespace drycut::sim::live {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

namespace {

constexpr std::size_t largest_message = 64U << 10U;  // [bytes] from a client
constexpr std::size_t largest_request = 16U << 10U;  // heading and body of HTTP
constexpr std::size_t most_connections = 256;        ///< that have asked for something
constexpr std::size_t most_unfinished = 64;          ///< others, whose request has not come yet
constexpr std::size_t most_waiting = 4U << 20U;      // [bytes] for one client; what comes then is left out
constexpr std::size_t most_news_to_come = 8;
constexpr std::size_t most_numbers = 50'000;  ///< of samples, to all clients, each time that the line tells
constexpr auto for_request = std::chrono::seconds(5);
constexpr auto patience = std::chrono::seconds(10);

using Text = std::shared_ptr<const std::string>;
using Asked = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

/// The value of `key` in the target's query; "" if there is none.
std::string query(std::string_view target, std::string_view key) {
  auto rest = target.substr(std::min(target.find('?'), target.size()));
  while (!rest.empty()) {
    rest.remove_prefix(1);
    const auto end = std::min(rest.find('&'), rest.size());
    const auto pair = rest.substr(0, end);
    const auto equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == key)
      return std::string(pair.substr(equals + 1));
    rest.remove_prefix(end);
  }
  return "";
}

/// Takes as long for each of the same length.
bool same_token(std::string_view given, std::string_view wanted) {
  if (given.size() != wanted.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < given.size(); ++i)
    difference |= static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(wanted[i]);
  return difference == 0;
}

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// Two news as one, without their samples.
std::shared_ptr<const News> merged(const News& earlier, const News& later) {
  constexpr std::size_t most_events = 400;
  auto both = std::make_shared<News>(later);
  both->samples = {};
  if (!both->outcome) both->outcome = earlier.outcome;
  if (earlier.run != later.run) return both;
  auto& events = both->events;
  events.insert(events.begin(), earlier.events.begin(), earlier.events.end());
  const auto more = events.size() - std::min(events.size(), most_events);
  events.erase(events.begin(), events.begin() + static_cast<std::ptrdiff_t>(more));
  both->events_left_out += earlier.events_left_out + more;
  return both;
}

}  // namespace

/// All of it, in the one thread of the server; others post into it.
struct Server::Core {
  class Client;

  /// Where others leave what a client is to be sent; it may be here longer than the server.
  struct Door {
    std::mutex mutex;
    asio::io_context* context = nullptr;  ///< nullptr: there is no server any more

    void put(std::weak_ptr<Client> to, std::string text);
  };

  Core(Options given, Line& of) : options(std::move(given)), line(of), acceptor(context) {
    door->context = &context;
    options.port = listen_at(acceptor, options.address, options.port, "", "--port");
  }

  void accept();
  void make_room();
  void tell(const News& news);
  void tell_samples(const News::Samples& samples);
  [[nodiscard]] bool knows_host(std::string_view host) const;
  [[nodiscard]] bool is_ours(const Asked& request) const;
  [[nodiscard]] bool may(const Asked& request) const;
  Response answer(const Asked& request) const;

  Options options;
  Line& line;
  Site site;
  // Clients take themselves out as they go, with the context at the latest.
  std::size_t connections = 0;
  std::list<Client*> unfinished;  ///< of them, by how long they have been
  Asker next_asker = 1;
  Asker served = 0;                                ///< who was sent samples last
  std::map<Asker, std::weak_ptr<Client>> clients;  ///< that talk over a WebSocket
  std::shared_ptr<Door> door = std::make_shared<Door>();
  asio::io_context context{1};
  tcp::acceptor acceptor;
  std::thread thread;
  std::shared_ptr<const LineDescription> description;
  Text described;
  std::mutex mutex;  ///< of what the line's thread leaves here
  std::deque<std::shared_ptr<const News>> news_to_come;
};

/// One connection: requests of HTTP, until one asks for a WebSocket.
class Server::Core::Client : public std::enable_shared_from_this<Client> {
 public:
  Client(Core& core, tcp::socket socket) : core_(core), stream_(std::move(socket)) { ++core_.connections; }
  ~Client() {
    --core_.connections;
    has_asked();
    if (asker_ == 0) return;
    core_.clients.erase(asker_);
    core_.line.ask({asker_, Leave{}});
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void read_request() {
    parser_.emplace();
    parser_->header_limit(largest_request);
    parser_->body_limit(largest_request);
    place_ = core_.unfinished.insert(core_.unfinished.end(), this);
    stream_.expires_after(for_request);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       self->has_asked();
                       if (!error) self->take_request();
                     });
  }
  /// It has been waited for long enough.
  void close() {
    has_asked();
    stream_.close();
  }

  /// To the client, if it takes it in; `needed`: it goes down rather than without it.
  void send(const Text& text, bool needed) {
    if (waiting_bytes_ + text->size() > most_waiting) {
      if (needed) beast::get_lowest_layer(*socket_).cancel();
      return;
    }
    waiting_.push_back(text);
    waiting_bytes_ += text->size();
    if (waiting_.size() == 1) write();
  }

  /// What it is to be sent of these; until the line has come to what it asked for last, what it asked for
  /// before.
  [[nodiscard]] const Sample& wanted(const News::Samples& samples) const {
    return knows(samples, wanted_) ? wanted_ : before_;
  }
  void answered(const Problems& problems) {
    if (open_.empty()) return;
    const auto [id, wanted] = std::move(open_.front());
    open_.pop_front();
    if (wanted && problems.empty()) before_ = std::exchange(wanted_, *wanted);
    if (id != 0 || !problems.empty())
      send(std::make_shared<const std::string>(answer_json(id, problems)), true);
  }

 private:
  void take_request() {
    const auto& request = parser_->get();
    if (websocket::is_upgrade(request) && core_.may(request) && view(request.target()).substr(0, 3) == "/ws")
      return open_socket(request);
    response_ = std::make_unique<Response>(core_.answer(request));
    stream_.expires_after(patience);
    http::async_write(stream_, *response_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error && self->response_->keep_alive()) return self->read_request();
      beast::error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  void open_socket(const Asked& request) {
    stream_.expires_never();
    socket_.emplace(std::move(stream_));
    auto timeout = websocket::stream_base::timeout::suggested(beast::role_type::server);
    timeout.handshake_timeout = patience;
    timeout.idle_timeout = 3 * patience;  // with pings of its own: who lives keeps its connection
    timeout.keep_alive_pings = true;
    socket_->set_option(timeout);
    socket_->read_message_max(largest_message);
    socket_->auto_fragment(false);
    socket_->async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->begin();
    });
  }

  void begin() {
    asker_ = core_.next_asker++;
    core_.clients[asker_] = weak_from_this();
    buffer_.clear();
    if (core_.described) send(core_.described, true);
    read_message();
  }

  void read_message() {
    socket_->async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return;
      self->take_message();
      self->read_message();
    });
  }

  void take_message() {
    const auto message = beast::buffers_to_string(buffer_.data());
    buffer_.consume(buffer_.size());
    double id = 0;
    Problems problems;
    auto request = parse_request(message, asker_, id, problems);
    if (!request) return send(std::make_shared<const std::string>(answer_json(id, problems)), true);
    request->bytes = message.size();
    auto* const read = std::get_if<Read>(&request->what);
    auto* const look = std::get_if<Look>(&request->what);
    if (read != nullptr)
      read->told = [door = core_.door, to = weak_from_this(), id](const auto& wrong, const auto& values) {
        door->put(to, values_json(id, wrong, values));
      };
    if (look != nullptr)
      look->told = [door = core_.door, to = weak_from_this(), id](const auto& wrong, const auto& seen) {
        door->put(to, seen_json(id, wrong, seen));
      };
    if (read != nullptr || look != nullptr) {
      if (!core_.line.ask(std::move(*request))) refuse(id);
      return;
    }
    const auto* sample = std::get_if<Sample>(&request->what);
    auto wanted = sample == nullptr ? std::nullopt : std::optional(*sample);
    if (!core_.line.ask(std::move(*request))) return refuse(id);
    open_.emplace_back(id, std::move(wanted));
  }

  void refuse(double id) {
    static const Text without_number = std::make_shared<const std::string>(busy_json(0));
    send(id == 0 ? without_number : std::make_shared<const std::string>(busy_json(id)), true);
  }

  void has_asked() {
    if (place_) core_.unfinished.erase(*place_);
    place_.reset();
  }

  void write() {
    socket_->text(true);
    socket_->async_write(asio::buffer(*waiting_.front()),
                         [self = shared_from_this()](beast::error_code error, std::size_t) {
                           self->waiting_bytes_ -= self->waiting_.front()->size();
                           self->waiting_.pop_front();
                           if (!error && !self->waiting_.empty()) self->write();
                         });
  }

  Core& core_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{largest_message + largest_request};
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::unique_ptr<Response> response_;
  std::optional<websocket::stream<beast::tcp_stream>> socket_;
  std::optional<std::list<Client*>::iterator> place_;  ///< among the unfinished
  Asker asker_ = 0;                                    ///< 0 = it has no WebSocket
  std::deque<Text> waiting_;
  std::size_t waiting_bytes_ = 0;
  Sample wanted_;  ///< channels that it is sent
  Sample before_;
  /// What the line has been asked and not answered: the message's number, channels to be sampled.
  std::deque<std::pair<double, std::optional<Sample>>> open_;
};

void Server::Core::Door::put(std::weak_ptr<Client> to, std::string text) {
  const std::lock_guard lock(mutex);
  if (context == nullptr) return;
  asio::post(*context, [to = std::move(to), text = std::make_shared<const std::string>(std::move(text))] {
    if (const auto client = to.lock()) client->send(text, true);
  });
}

void Server::Core::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) make_room();
    if (!error && connections - unfinished.size() < most_connections) {
      socket.set_option(tcp::no_delay(true), error);
      std::make_shared<Client>(*this, std::move(socket))->read_request();
    }
    accept();
  });
}

// Who opens connections and asks for nothing locks nobody out.
void Server::Core::make_room() {
  if (unfinished.size() >= most_unfinished) unfinished.front()->close();
}

// A page of another site can have a name of its own lead here: then the host is that name.
bool Server::Core::knows_host(std::string_view host) const {
  const auto port = fmt::format(":{}", options.port);
  for (const auto* name : {"localhost", "127.0.0.1", "[::1]"})
    if (host == name + port || (options.port == 80 && host == name)) return true;
  return !options.token.empty();  // which such a page does not have
}

/// Asked by a page of this server, or by nobody's.
bool Server::Core::is_ours(const Asked& request) const {
  const auto host = view(request[http::field::host]);
  if (!knows_host(host)) return false;
  const auto origin = view(request[http::field::origin]);
  return origin.empty() || origin == fmt::format("http://{}", host);
}

bool Server::Core::may(const Asked& request) const {
  if (!is_ours(request)) return false;
  return options.token.empty() || same_token(query(view(request.target()), "token"), options.token);
}

Response Server::Core::answer(const Asked& request) const {
  Response response(http::status::ok, request.version());
  response.keep_alive(request.keep_alive());
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Content-Security-Policy",
               "default-src 'none'; script-src 'self'; style-src 'self'; img-src data:; connect-src 'self'; "
               "frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
  const auto give = [&](const char* type, std::string body) {
    response.set(http::field::content_type, type);
    response.body() = std::move(body);
  };
  const auto path = view(request.target()).substr(0, view(request.target()).find('?'));
  // The page's parts tell nothing of the line: they need no token, which they could not show.
  const auto file = site.find(path);
  const bool is_part = file && path != "/";
  if (!may(request) && !(is_part && is_ours(request))) {
    response.result(http::status::forbidden);
    give("text/plain; charset=utf-8", "this line takes requests of its own page only\n");
  } else if (request.method() != http::verb::get && request.method() != http::verb::head) {
    response.result(http::status::method_not_allowed);
    give("text/plain; charset=utf-8", "GET\n");
  } else if (file) {
    give(file->type, std::string(file->bytes));
  } else if (path == "/line.json" && described) {
    give("application/json", *described);
  } else if (path == "/machine.glb" && description) {
    give("model/gltf-binary", description->machine);
  } else {
    response.result(http::status::not_found);
    give("text/plain; charset=utf-8", "there is no such page\n");
  }
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();
  return response;
}

Server::Server(Options options, Line& line) : core_(std::make_unique<Core>(std::move(options), line)) {
  core_->accept();
  core_->thread = std::thread([this] { core_->context.run(); });
  pthread_setname_np(core_->thread.native_handle(), "server");
}

Server::~Server() {
  {
    const std::lock_guard lock(core_->door->mutex);
    core_->door->context = nullptr;
  }
  core_->context.stop();
  core_->thread.join();
}

std::uint16_t Server::port() const { return core_->options.port; }

std::string Server::url() const {
  const auto& [address, port, token] = core_->options;
  return fmt::format("http://{}:{}/{}",
                     address.find(':') == std::string::npos ? address : "[" + address + "]", port,
                     token.empty() ? "" : "?token=" + token);
}

void Server::Core::tell(const News& news) {
  if (clients.empty()) return;
  const auto text = std::make_shared<const std::string>(news_json(news));
  for (const auto& [asker, held] : clients)
    if (const auto client = held.lock()) client->send(text, false);
  if (!news.samples.times.empty()) tell_samples(news.samples);
}

// By turns: where there is more than can be told, each one's curves have gaps, and nobody else's page waits.
// What several want is written once.
void Server::Core::tell_samples(const News::Samples& samples) {
  std::vector<std::pair<Sample, Text>> written;
  std::size_t numbers = 0;
  auto next = clients.upper_bound(served);
  for (auto left = clients.size(); left > 0 && numbers < most_numbers; --left, ++next) {
    if (next == clients.end()) next = clients.begin();
    served = next->first;
    const auto client = next->second.lock();
    if (!client) continue;
    const auto& wanted = client->wanted(samples);
    auto same =
        std::find_if(written.begin(), written.end(), [&](const auto& one) { return one.first == wanted; });
    if (same == written.end()) {
      numbers += samples.times.size() * (wanted.names.size() - wanted.watched) + wanted.watched;
      written.emplace_back(wanted, std::make_shared<const std::string>(samples_json(samples, wanted)));
      same = std::prev(written.end());
    }
    if (!same->second->empty()) client->send(same->second, false);
  }
}

void Server::tell(std::shared_ptr<const News> news) {
  {
    const std::lock_guard lock(core_->mutex);
    auto& to_come = core_->news_to_come;
    if (to_come.size() >= most_news_to_come) {  // it comes behind: curves have a gap, events are told later
      to_come.back() = merged(*to_come.back(), *news);
      return;
    }
    to_come.push_back(std::move(news));
  }
  asio::post(core_->context, [core = core_.get()] {
    std::unique_lock lock(core->mutex);
    const auto first = std::move(core->news_to_come.front());
    core->news_to_come.pop_front();
    lock.unlock();
    core->tell(*first);
  });
}

void Server::answer(std::vector<Answer> answers) {
  asio::post(core_->context, [core = core_.get(), answers = std::move(answers)] {
    for (const auto& [asker, problems] : answers) {
      const auto found = core->clients.find(asker);
      if (found == core->clients.end()) continue;
      if (const auto client = found->second.lock()) client->answered(problems);
    }
  });
}

void Server::describe(std::shared_ptr<const LineDescription> line) {
  asio::post(core_->context, [this, line = std::move(line)] {
    core_->description = line;
    core_->described = std::make_shared<const std::string>(description_json(*line));
    for (const auto& [asker, held] : core_->clients)
      if (const auto client = held.lock()) client->send(core_->described, true);
  });
}

}  // namespace drycut::sim::live
