#include "sim/live/modbus/server.hpp"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/tcp_stream.hpp>

#include <array>
#include <chrono>
#include <deque>
#include <map>
#include <mutex>
#include <thread>

#include "sim/live/line_run.hpp"
#include "sim/live/modbus/face_data.hpp"
#include "sim/live/port.hpp"

namespace drycut::sim::live::modbus {

namespace asio = boost::asio;
namespace beast = boost::beast;
using tcp = asio::ip::tcp;

namespace {

constexpr std::size_t most_connections = 64;
constexpr std::size_t most_a_cycle = 2000;  ///< of requests between two cycles, see cost_of()
constexpr auto patience = std::chrono::seconds(10);

using FaceOr = std::variant<const devices::ModbusFace*, std::string>;

FaceOr face_of(LineRun& run) {
  const auto* controller = run.simulation().controller();
  return controller != nullptr ? controller->modbus() : FaceOr("a controller: the scenario has none");
}

Host host_of(LineRun& run) {
  return {[&run](const std::string& name) { return run.simulation().controller()->find(name); },
          [&run](const std::vector<std::pair<std::string, double>>& values) {
            scenario::Stimulus act;
            act.at = run.now();
            act.set.reserve(values.size());
            for (const auto& [name, number] : values)
              act.set.emplace_back(scenario::Text{name, {}}, scenario::Quantity{number, "", {}});
            return run.act(act).empty();
          },
          [&run] { return run.now(); }};
}

}  // namespace

std::string lacking(Line& line) {
  const auto face = face_of(line.present());
  const auto* remedy = std::get_if<std::string>(&face);
  return remedy == nullptr ? "" : *remedy;
}

using ClientNumber = std::uint64_t;

/// Where requests lie until the line looks at them between two cycles. The server puts them there, the line's
/// thread answers; it outlives both.
struct ModbusServer::Desk : std::enable_shared_from_this<Desk> {
  struct Job {
    ClientNumber client;
    ModbusFrame frame;
  };

  void put(Job job) {
    const std::lock_guard lock(mutex);
    waiting.push_back(std::move(job));
    ask();
  }
  /// In the line's thread.
  void serve(LineRun& run);
  void answer(LineRun& run, ModbusFrame& frame);
  void tell_closed(int unit);

  std::mutex mutex;
  Core* core = nullptr;  ///< nullptr: the server is gone
  std::deque<Job> waiting;
  bool asked = false;  ///< the line will look at them

  // Of the line's thread:
  int run_number = 0;
  bool told_closed = false;  ///< of that run
  const devices::ModbusFace* face = nullptr;
  std::optional<FaceData> data;

 private:
  void ask();
  std::vector<Job> take();
};

/// All connections, in the one thread of the server; others post into it.
struct ModbusServer::Core {
  class Client;

  Core(Options given, Line& of, Desk& at) : options(std::move(given)), line(of), desk(at), acceptor(context) {
    options.port = listen_at(acceptor, options.address, options.port, " for Modbus", "--modbus");
  }

  void accept();
  void make_room();

  Options options;
  Line& line;
  Desk& desk;
  ClientNumber next = 1;
  std::uint64_t heard = 0;                  ///< connections and frames so far: who was silent for longest
  std::map<ClientNumber, Client*> clients;  ///< that are not closed; they take themselves out as they go
  asio::io_context context{1};
  tcp::acceptor acceptor;
  std::map<ClientNumber, std::shared_ptr<Client>> waiting;  ///< whose request the line has
  std::thread thread;
};

/// One connection; one request of it at a time is under way.
class ModbusServer::Core::Client : public std::enable_shared_from_this<Client> {
 public:
  Client(Core& core, tcp::socket socket)
      : core_(core), stream_(std::move(socket)), number_(core.next++), heard_(++core.heard) {
    core_.clients[number_] = this;
  }
  ~Client() { core_.clients.erase(number_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void go_on() {
    if (auto frame = reader_.next()) {
      heard_ = ++core_.heard;
      core_.waiting[number_] = shared_from_this();
      return core_.desk.put({number_, std::move(*frame)});
    }
    if (!reader_.broken()) read();
  }
  void answer(const ModbusFrame& frame) {
    bytes_ = bytes_of(frame);
    stream_.expires_after(patience);
    asio::async_write(stream_, asio::buffer(bytes_),
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (!error) self->go_on();
                      });
  }
  void close() {
    core_.clients.erase(number_);
    stream_.close();
  }
  [[nodiscard]] std::uint64_t heard() const { return heard_; }

 private:
  void read() {
    if (reader_.begun())
      stream_.expires_after(patience);
    else
      stream_.expires_never();
    stream_.async_read_some(asio::buffer(buffer_),
                            [self = shared_from_this()](beast::error_code error, std::size_t count) {
                              if (error) return;
                              self->reader_.take(std::span(self->buffer_).first(count));
                              self->go_on();
                            });
  }

  Core& core_;
  beast::tcp_stream stream_;
  ClientNumber number_;
  std::uint64_t heard_;
  FrameReader reader_;
  std::array<std::uint8_t, 1024> buffer_{};
  Bytes bytes_;  ///< of the answer that is being sent
};

void ModbusServer::Core::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) {
      make_room();
      socket.set_option(tcp::no_delay(true), error);
      socket.set_option(asio::socket_base::keep_alive(true), error);  // who is gone without a word is found
      std::make_shared<Client>(*this, std::move(socket))->go_on();
    }
    accept();
  });
}

// What an HMI that lost its line leaves behind must not lock it out: the guide for TCP says so too (§4.2.1).
void ModbusServer::Core::make_room() {
  if (clients.size() < most_connections) return;
  auto* silent = clients.begin()->second;
  for (const auto& [number, client] : clients)
    if (client->heard() < silent->heard()) silent = client;
  silent->close();
}

void ModbusServer::Desk::ask() {
  if (asked || waiting.empty() || core == nullptr) return;
  asked = true;
  core->line.ask({0, Visit{[self = shared_from_this()](LineRun& run) { self->serve(run); }}});
}

/// As many as fit between two cycles.
std::vector<ModbusServer::Desk::Job> ModbusServer::Desk::take() {
  const std::lock_guard lock(mutex);
  std::vector<Job> taken;
  std::size_t cost = 0;
  while (!waiting.empty() && cost < most_a_cycle) {
    cost += cost_of(waiting.front().frame.pdu);
    taken.push_back(std::move(waiting.front()));
    waiting.pop_front();
  }
  return taken;
}

void ModbusServer::Desk::serve(LineRun& run) {
  auto jobs = take();
  for (auto& job : jobs) answer(run, job.frame);
  const std::lock_guard lock(mutex);
  asked = false;
  if (core == nullptr) return;
  asio::post(core->context, [at = core, jobs = std::move(jobs)] {
    for (const auto& [number, frame] : jobs)
      if (auto client = at->waiting.extract(number)) client.mapped()->answer(frame);
  });
  ask();
}

void ModbusServer::Desk::answer(LineRun& run, ModbusFrame& frame) {
  if (run_number != run.number()) {
    run_number = run.number();
    told_closed = false;
    data.reset();
    const auto shown = face_of(run);
    face = std::holds_alternative<std::string>(shown) ? nullptr : std::get<0>(shown);
    if (face != nullptr) data.emplace(*face, host_of(run));
  }
  if (!data) {
    frame.pdu = refusal(frame.pdu, Exception::server_device_failure);
  } else if (!face->answers(frame.unit)) {
    tell_closed(frame.unit);
    frame.pdu = refusal(frame.pdu, Exception::gateway_target_failed);
  } else {
    frame.pdu = modbus::answer(frame.pdu, *data);
  }
}

// Once a run: a master that asks again and again hears it from its exception.
void ModbusServer::Desk::tell_closed(int unit) {
  if (std::exchange(told_closed, true)) return;
  fmt::print(
      "Modbus: unit {} does not answer (exception 11): the controller has no power, the program has not "
      "opened "
      "its device as a slave, or it is another unit\n",
      unit);
  std::fflush(stdout);
}

ModbusServer::ModbusServer(Options options, Line& line)
    : desk_(std::make_shared<Desk>()), core_(std::make_unique<Core>(std::move(options), line, *desk_)) {
  desk_->core = core_.get();
  core_->accept();
  core_->thread = std::thread([this] { core_->context.run(); });
}

ModbusServer::~ModbusServer() {
  {
    const std::lock_guard lock(desk_->mutex);
    desk_->core = nullptr;
  }
  core_->context.stop();
  core_->thread.join();
}

std::uint16_t ModbusServer::port() const { return core_->options.port; }

}  // namespace drycut::sim::live::modbus
