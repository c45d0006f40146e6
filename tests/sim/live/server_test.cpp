// Who may talk to a line, and what happens to those who talk nonsense.
#include "sim/live/server.hpp"

#include <fmt/format.h>

#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <future>
#include <nlohmann/json.hpp>

#include "tests/sim/live/live_bench.hpp"

namespace drycut::sim::live {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using tcp = asio::ip::tcp;
using testing::HasSubstr;
using testing::StartsWith;
using Socket = beast::websocket::stream<tcp::socket>;

/// A line with its server, and clients of it.
struct LiveServer : testing::Test {
  explicit LiveServer(const std::string& token = "") : query(token.empty() ? "" : "?token=" + token) {
    Problems problems;
    line = std::make_unique<Line>(Line::Options{.scenario = folder.file("web.yaml", web_alone),
                                                .set = {},
                                                .pace = 1,
                                                .running = true,
                                                .record = {}},
                                  problems);
    server = std::make_unique<Server>(Server::Options{"127.0.0.1", 0, token}, *line);
    thread = std::thread([this] {
      line->run({[this](auto news) { server->tell(std::move(news)); },
                 [this](auto told) { server->describe(std::move(told)); },
                 [this](auto answers) { server->answer(std::move(answers)); }});
    });
    host = "127.0.0.1:" + std::to_string(server->port());
    Socket first = connect();  // the line has been described
    EXPECT_THAT(message(first), StartsWith("{\"line\""));
  }
  ~LiveServer() override {
    line->stop();
    thread.join();
  }

  tcp::socket raw() {
    tcp::socket socket(context);
    socket.connect({asio::ip::make_address("127.0.0.1"), server->port()});
    return socket;
  }
  /// All that comes back until the server closes.
  std::string answer(const std::string& request) {
    auto socket = raw();
    beast::error_code error;
    asio::write(socket, asio::buffer(request), error);
    std::string text;
    asio::read(socket, asio::dynamic_buffer(text), error);
    return text;
  }
  std::string get(const std::string& target, const std::string& fields) {
    return answer("GET " + target + " HTTP/1.1\r\nConnection: close\r\n" + fields + "\r\n");
  }
  Socket connect(const std::string& origin = "") {
    Socket socket(raw());
    if (!origin.empty())
      socket.set_option(
          beast::websocket::stream_base::decorator([origin](beast::websocket::request_type& request) {
            request.set(beast::http::field::origin, origin);
          }));
    socket.handshake(host, "/ws" + query);
    return socket;
  }
  static std::string message(Socket& socket) {
    beast::flat_buffer buffer;
    socket.read(buffer);
    return beast::buffers_to_string(buffer.data());
  }
  static nlohmann::json message_with(Socket& socket, const std::string& key) {
    for (int i = 0; i < 10000; ++i) {
      auto json = nlohmann::json::parse(message(socket));
      if (json.contains(key)) return json[key].is_object() ? json[key] : json;
    }
    return {};
  }

  TestFolder folder;
  asio::io_context context;
  std::string host;
  std::string query;
  std::unique_ptr<Line> line;
  std::unique_ptr<Server> server;
  std::thread thread;
};

TEST_F(LiveServer, GivesItsPageToItsOwn) {
  EXPECT_THAT(get("/", "Host: " + host + "\r\n"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(get("/", "Host: localhost:" + std::to_string(server->port()) + "\r\n"),
              StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(get("/machine.glb", "Host: " + host + "\r\n"), HasSubstr("model/gltf-binary"));
  EXPECT_THAT(get("/line.json", "Host: " + host + "\r\nOrigin: http://" + host + "\r\n"),
              HasSubstr("\"A web\""));
}

TEST_F(LiveServer, RefusesWhatIsNoneOfItsOwn) {
  struct Case {
    const char* target;
    std::string fields;
    const char* status;
  };
  const Case cases[] = {
      {"/", "", "403"},
      {"/", "Host: evil.example\r\n", "403"},
      {"/", "Host: evil.example:" + std::to_string(server->port()) + "\r\n", "403"},
      {"/", "Host: " + host + ".evil.example\r\n", "403"},
      {"/line.json", "Host: " + host + "\r\nOrigin: http://evil.example\r\n", "403"},
      {"/line.json", "Host: " + host + "\r\nOrigin: null\r\n", "403"},
      {"/../../etc/passwd", "Host: " + host + "\r\n", "404"},
      {"/%2e%2e/etc/passwd", "Host: " + host + "\r\n", "404"},
      {"/nothing", "Host: " + host + "\r\n", "404"},
  };
  for (const auto& [target, fields, status] : cases)
    EXPECT_THAT(get(target, fields), StartsWith(std::string("HTTP/1.1 ") + status))
        << target << " " << fields;
  EXPECT_THAT(answer("POST / HTTP/1.1\r\nConnection: close\r\nHost: " + host + "\r\n\r\n"),
              StartsWith("HTTP/1.1 405"));
}

TEST_F(LiveServer, OpensNoSocketForAnotherPage) {
  EXPECT_THROW(connect("http://evil.example"), boost::system::system_error);
  auto own = connect("http://" + host);
  EXPECT_THAT(message(own), StartsWith("{\"line\""));
}

TEST_F(LiveServer, ReadsValuesAtOnce) {
  auto client = connect();
  client.text(true);
  const auto ask = [&](const std::string& words) {
    client.write(asio::buffer(words));
    return message_with(client, "done");
  };
  const auto read = ask(R"({"read": ["web.speed", "web.position"], "id": 7})");
  EXPECT_EQ(read["done"], 7);
  EXPECT_EQ(read["problems"].size(), 0U);
  ASSERT_EQ(read["values"].size(), 2U);
  EXPECT_GE(read["values"][0].get<double>(), 29);
  EXPECT_LE(read["values"][0].get<double>(), 61);
  const auto wrong = ask(R"({"read": ["web.spede", "web.position"], "id": 8})");
  EXPECT_EQ(wrong["values"].size(), 0U);
  ASSERT_EQ(wrong["problems"].size(), 1U);
  EXPECT_THAT(wrong["problems"][0]["what"].get<std::string>(), HasSubstr("web.spede"));
  EXPECT_THAT(wrong["problems"][0]["remedy"].get<std::string>(), HasSubstr("web.speed"));
  EXPECT_EQ(ask(R"({"read": "web.speed", "id": 9})")["problems"].size(), 1U);
}

TEST_F(LiveServer, NonsenseEndsTheConnectionThatItCameOn) {
  EXPECT_EQ(answer(std::string(200, '\xff') + "\r\n\r\n"), "");
  EXPECT_EQ(answer("GET / HTTP/1.1\r\nHost: " + std::string(100'000, 'a')), "");
  auto large = connect();
  large.text(true);
  beast::error_code error;
  large.write(asio::buffer(std::string(100'000, ' ')), error);
  for (int i = 0; i < 10000 && !error; ++i) {
    beast::flat_buffer buffer;
    large.read(buffer, error);
  }
  EXPECT_TRUE(error);
  auto next = connect();
  EXPECT_THAT(message(next), StartsWith("{\"line\""));
}

TEST_F(LiveServer, CarriesWhatIsAskedAndWhatBecameOfIt) {
  auto socket = connect();
  const auto ask = [&](const std::string& text) {
    socket.write(asio::buffer(text));
    return message_with(socket, "done");
  };
  EXPECT_EQ(ask(R"({"id": 7, "act": {"set": {"web.speed": "45 m/min"}}})"),
            nlohmann::json::parse(R"({"done": 7.0, "problems": []})"));
  const auto refused = ask(R"({"id": 8, "act": {"set": {"web.sped": 1}}})");
  EXPECT_EQ(refused["done"], 8);
  EXPECT_THAT(refused["problems"][0]["what"], HasSubstr("web.sped"));
  EXPECT_EQ(ask("no json")["problems"][0]["what"], "the message is no JSON object");
  EXPECT_EQ(ask(R"({"id": 9, "sample": ["web.speed"]})")["done"], 9);
  const auto samples = message_with(socket, "samples");
  EXPECT_EQ(samples["names"], nlohmann::json::parse(R"(["web.speed"])"));
  EXPECT_EQ(samples["times"].size(), samples["rows"].size());
}

TEST_F(LiveServer, WhoBeginsARequestAndNeverEndsItLocksNobodyOut) {
  auto page = connect();
  std::vector<tcp::socket> half_open;
  for (int i = 0; i < 400; ++i) {
    half_open.push_back(raw());
    if (i % 2 == 0) asio::write(half_open.back(), asio::buffer(std::string("GET / HTTP/1.1\r\nHost: ")));
    if (i % 50 == 49) {
      EXPECT_THAT(get("/", "Host: " + host + "\r\n"), StartsWith("HTTP/1.1 200")) << i;
    }
  }
  EXPECT_THAT(message(page), StartsWith("{\"line\""));
  auto another = connect();
  EXPECT_THAT(message(another), StartsWith("{\"line\""));
}

TEST_F(LiveServer, SaysThatItIsBusy) {
  std::promise<void> go;
  line->ask({0, Visit{[&](LineRun&) { go.get_future().wait(); }}});
  auto flood = connect();
  constexpr int more = 5;
  const int most = static_cast<int>(Inbox::most_of_one);
  for (int id = 1; id <= most + more; ++id)
    flood.write(
        asio::buffer(fmt::format(R"({{"id": {}, "act": {{"set": {{"web.speed": "45 m/min"}}}}}})", id)));
  const auto answer = [&](Socket& of) {
    for (;;) {
      auto json = nlohmann::json::parse(message(of));
      if (json.contains("done")) return json;
    }
  };
  for (int id = most + 1; id <= most + more; ++id) {
    const auto busy = answer(flood);
    EXPECT_EQ(busy["done"], id);
    EXPECT_EQ(busy["busy"], true);
    EXPECT_THAT(busy["problems"][0]["what"], StartsWith("busy"));
  }
  auto other = connect();
  other.write(asio::buffer(std::string(R"({"id": 1, "act": {"set": {"web.speed": "40 m/min"}}})")));
  go.set_value();
  EXPECT_EQ(answer(other), nlohmann::json::parse(R"({"done": 1, "problems": []})")) << "it has asked once";
  for (int id = 1; id <= most; ++id)
    EXPECT_EQ(answer(flood), nlohmann::json({{"done", id}, {"problems", nlohmann::json::array()}}));
}

TEST_F(LiveServer, FiftyClientsAndOneThatNeverReads) {
  auto deaf = connect();
  deaf.write(asio::buffer(std::string(R"({"sample": ["web.speed", "web.position"]})")));
  auto half_open = raw();
  std::vector<Socket> clients;
  for (int i = 0; i < 50; ++i) clients.push_back(connect());
  for (auto& client : clients) EXPECT_THAT(message(client), StartsWith("{\"line\""));
  double time = 0;
  for (auto& client : clients) time = std::max(time, message_with(client, "news")["time"].get<double>());
  EXPECT_GT(message_with(clients.front(), "news")["time"].get<double>(), 0);
  EXPECT_GT(time, 0);
}

struct LiveServerWithToken : LiveServer {
  LiveServerWithToken() : LiveServer("0123456789abcdef") {}
};

TEST_F(LiveServerWithToken, IsForThoseWhoShowIt) {
  EXPECT_THAT(get("/?token=0123456789abcdef", "Host: " + host + "\r\n"), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(
      get("/?a=b&token=0123456789abcdef", "Host: 192.0.2.7:" + std::to_string(server->port()) + "\r\n"),
      StartsWith("HTTP/1.1 200"));
  for (const auto* target :
       {"/", "/?token=", "/?token=0123456789abcdee", "/?token=0123456789abcdef0", "/line.json"})
    EXPECT_THAT(get(target, "Host: " + host + "\r\n"), StartsWith("HTTP/1.1 403")) << target;
  query = "?token=no";
  EXPECT_THROW(connect(), boost::system::system_error);
}

}  // namespace
}  // namespace drycut::sim::live
