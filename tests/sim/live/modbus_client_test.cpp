// libmodbus as the HMI of a live line: each controller's map, many clients, clients that misbehave, replay.
#include <fmt/format.h>
#include <modbus/modbus.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <future>
#include <optional>

#include "sim/cli/live_command.hpp"
#include "sim/cli/run_command.hpp"
#include "sim/live/line_run.hpp"
#include "sim/live/modbus/server.hpp"
#include "tests/sim/command_bench.hpp"
#include "tests/sim/live/live_bench.hpp"

namespace drycut::sim::live {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using Words = std::vector<std::uint16_t>;
using Bits = std::vector<std::uint8_t>;

/// An HMI. Each function gives what came, or nothing and the error in `error`.
class Hmi {
 public:
  explicit Hmi(int port, int unit = 1) : context_(modbus_new_tcp("127.0.0.1", port)) {
    modbus_set_slave(context_, unit);
    modbus_set_response_timeout(context_, 30, 0);
    EXPECT_EQ(modbus_connect(context_), 0) << modbus_strerror(errno);
  }
  ~Hmi() {
    modbus_close(context_);
    modbus_free(context_);
  }
  Hmi(const Hmi&) = delete;
  Hmi& operator=(const Hmi&) = delete;

  Words holding(int address, int count) { return words(modbus_read_registers, address, count); }
  Words input(int address, int count) { return words(modbus_read_input_registers, address, count); }
  Bits coils(int address, int count) { return bits(modbus_read_bits, address, count); }
  Bits inputs(int address, int count) { return bits(modbus_read_input_bits, address, count); }
  bool write(int address, int word) {
    return done(modbus_write_register(context_, address, static_cast<std::uint16_t>(word)));
  }
  bool write(int address, const Words& values) {
    return done(modbus_write_registers(context_, address, static_cast<int>(values.size()), values.data()));
  }
  bool coil(int address, bool on) { return done(modbus_write_bit(context_, address, on)); }
  bool coil(int address, const Bits& values) {
    return done(modbus_write_bits(context_, address, static_cast<int>(values.size()), values.data()));
  }
  bool mask(int address, int with_and, int with_or) {
    return done(modbus_mask_write_register(context_, address, static_cast<std::uint16_t>(with_and),
                                           static_cast<std::uint16_t>(with_or)));
  }
  Words exchange(int write_address, const Words& values, int address, int count) {
    Words read(static_cast<std::size_t>(count));
    const bool sound =
        done(modbus_write_and_read_registers(context_, write_address, static_cast<int>(values.size()),
                                             values.data(), address, count, read.data()));
    return sound ? read : Words{};
  }
  void unit(int number) { modbus_set_slave(context_, number); }

  int error = 0;

 private:
  bool done(int result) {
    error = result < 0 ? errno : 0;
    return result >= 0;
  }
  template <typename Read>
  Words words(Read read, int address, int count) {
    Words values(static_cast<std::size_t>(count));
    return done(read(context_, address, count, values.data())) ? values : Words{};
  }
  template <typename Read>
  Bits bits(Read read, int address, int count) {
    Bits values(static_cast<std::size_t>(count));
    return done(read(context_, address, count, values.data())) ? values : Bits{};
  }

  modbus_t* context_;
};

/// A line with Modbus that runs as fast as it goes.
struct ModbusLine : CommandTest {
  void begin(const std::string& scenario, bool running = true) {
    line = std::make_unique<RunningLine>(Line::Options{.scenario = folder.file("line.yaml", scenario),
                                                       .set = {},
                                                       .pace = 0,
                                                       .running = running,
                                                       .record = folder / "record"});
    server.emplace(modbus::ModbusServer::Options{"127.0.0.1", 0}, *line->line);
  }
  /// Of the controller, as the run has it between two cycles.
  double now(const std::string& name) {
    std::promise<double> promise;
    line->line->ask({0, Visit{[&](LineRun& run) {
                       const auto reading = run.simulation().names().reading(name);
                       promise.set_value(reading ? reading->read() : std::nan(""));
                     }}});
    return promise.get_future().get();
  }
  /// The same once a cycle has run: what was written before has been taken by then. Of a line that runs.
  double settled(const std::string& name) {
    const auto time = [&] {
      std::promise<Time> promise;
      line->line->ask({0, Visit{[&](LineRun& run) { promise.set_value(run.now()); }}});
      return promise.get_future().get();
    };
    const auto asked = time();
    while (time() == asked) {
    }
    return now(name);
  }
  /// Ends the session and runs it again: the same bytes.
  void expect_same_again() {
    server.reset();
    line.reset();
    cli::ReplayOptions options;
    options.session = folder / "record/1";
    options.out = folder / "again";
    options.pictures = false;
    captured([&] { return cli::replay_session(options); });
    EXPECT_EQ(err, "");
    for (const auto* file : {"trace.csv", "events.csv"}) {
      const auto bytes = [&](const fs::path& in) {
        std::ifstream stream(folder / in.string() / file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
      };
      EXPECT_THAT(bytes("record/1"), testing::StartsWith("time [s],"));
      EXPECT_EQ(bytes("record/1"), bytes("again/session")) << file;
    }
  }

  TestFolder folder;
  std::unique_ptr<RunningLine> line;
  std::optional<modbus::ModbusServer> server;
};

struct ModbusLx3vpLine : ModbusLine {
  void begin_plc(bool running = true) {
    folder.file("hmi.il",
                "LD X0\nOUT Y10\nLD M0\nOUT Y1\nLD M8000\nADD D0 K1 D1\nLD M10\nOUT T5 K1000\nEND\n");
    begin(R"(scene: {title: Plc, step: 100 us, duration: 1000 h}
plants: {bench: {type: bench}}
controller: {lx3vp: {program: hmi.il, scan: 1 ms, set: {D100: -5}}}
wiring: {X0: bench.input1, Y10: bench.output1}
timeline: [{at: 1 ms, set: {bench.input1: 1}}]
record: {every: 100 ms, channels: [D0, D1, C200, M0, Y1]}
)",
          running);
  }
};

TEST_F(ModbusLx3vpLine, WordsAreReadAndWrittenOverTheWholeMap) {
  begin_plc();
  Hmi hmi(server->port());
  struct Range {
    int address;
    int count;
    int each;  ///< addresses of a value
    const char* name;
    int first;
  };
  // D1 is the program's, D8000 and above the PLC's own.
  for (const auto& [address, count, each, name, first] : {Range{2, 7998, 1, "D", 2},
                                                          {0xF000, 256, 1, "T", 0},
                                                          {0xF400, 200, 1, "C", 0},
                                                          {0xF700, 56, 2, "C", 200}}) {
    Words values(static_cast<std::size_t>(count * each));
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<std::uint16_t>((i * 2654435761U >> 8) & (*name == 'T' ? 0x7FFF : 0xFFFF));
    if (*name == 'T') values[5] = 0;  // the program's
    Words read;
    Words again;
    constexpr std::size_t most = 120;
    for (std::size_t at = 0; at < values.size(); at += most) {
      const auto part = static_cast<std::ptrdiff_t>(std::min(most, values.size() - at));
      const auto begin = values.begin() + static_cast<std::ptrdiff_t>(at);
      ASSERT_TRUE(hmi.write(address + static_cast<int>(at), Words(begin, begin + part)));
      const auto back = hmi.holding(address + static_cast<int>(at), static_cast<int>(part));
      read.insert(read.end(), back.begin(), back.end());
      const auto same = hmi.input(address + static_cast<int>(at), static_cast<int>(part));
      again.insert(again.end(), same.begin(), same.end());
    }
    EXPECT_EQ(read, values) << name << first;
    EXPECT_EQ(again, values);
    for (const int i : {0, 1, count / 2, count - 1}) {
      const auto at = static_cast<std::size_t>(i * each);
      const double wanted = each == 2      ? static_cast<std::int32_t>(values[at] | values[at + 1] << 16)
                            : *name == 'T' ? values[at]
                                           : static_cast<std::int16_t>(values[at]);
      EXPECT_EQ(settled(name + std::to_string(first + i)), wanted) << name << first + i;
    }
  }
}

TEST_F(ModbusLx3vpLine, BitsAreReadAndWrittenOverTheWholeMap) {
  begin_plc();
  Hmi hmi(server->port());
  struct Range {
    int address;
    int count;
    const char* name;
  };
  for (const auto& [address, count, name] : {Range{0, 1968, "M"},
                                             {1968, 3072 - 1968, "M"},
                                             {0xE000, 1000, "S"},
                                             {0xF000, 256, "TS"},
                                             {0xF400, 256, "CS"}}) {
    Bits values(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = (i * 2654435761U >> 9) & 1;
    if (address == 0) values[10] = 0;  // drives T5
    if (address == 0xF000) values[5] = 0;
    ASSERT_TRUE(hmi.coil(address, values)) << modbus_strerror(hmi.error);
    EXPECT_EQ(hmi.coils(address, count), values) << name;
    EXPECT_EQ(hmi.inputs(address, count), values) << name;
    const int first = address == 1968 ? 1968 : 0;
    for (const int i : {0, 1, count / 2, count - 1})
      EXPECT_EQ(settled(name + std::to_string(first + i)), values[static_cast<std::size_t>(i)])
          << name << first + i;
  }
  EXPECT_THAT(hmi.coils(8000, 2), ElementsAre(1, 0)) << "M8000 is on while it runs, M8001 is its opposite";
  EXPECT_THAT(hmi.coils(0xF800, 2), ElementsAre(1, 0)) << "X0 is wired and on";
  EXPECT_THAT(hmi.coils(0xFC08, 1), ElementsAre(1)) << "Y10 is what the program makes of it";
  EXPECT_EQ(hmi.coils(0xF800, 256).size(), 256U);
  EXPECT_EQ(hmi.coils(0xFC00, 256).size(), 256U);
}

TEST_F(ModbusLx3vpLine, TheProgramAndTheHmiShareTheRegisters) {
  begin_plc();
  Hmi hmi(server->port());
  EXPECT_THAT(hmi.holding(100, 1), ElementsAre(0xFFFB)) << "-5 of the scenario";
  ASSERT_TRUE(hmi.write(0, 41));
  while (now("D1") != 42) {
  }
  EXPECT_THAT(hmi.holding(0, 2), ElementsAre(41, 42));
  ASSERT_TRUE(hmi.coil(0, true));
  while (now("Y1") != 1) {
  }
  ASSERT_TRUE(hmi.coil(0xFC02, true)) << "an output that no program drives";
  while (now("Y2") != 1) {
  }
  ASSERT_TRUE(hmi.mask(0, 0xF0F0, 0x0005));
  EXPECT_THAT(hmi.holding(0, 1), ElementsAre((41 & 0xF0F0) | (5 & ~0xF0F0)));
  EXPECT_THAT(hmi.exchange(10, {1, 2, 3}, 9, 5), ElementsAre(0, 1, 2, 3, 0));
  ASSERT_TRUE(hmi.write(0xF701, 2)) << "the upper word alone";
  ASSERT_TRUE(hmi.write(0xF700, 1)) << "the lower one alone";
  EXPECT_THAT(hmi.holding(0xF700, 2), ElementsAre(1, 2));
  expect_same_again();
}

TEST_F(ModbusLx3vpLine, ALineThatStandsStillShowsWhatWasWritten) {
  begin_plc(false);
  Hmi hmi(server->port());
  ASSERT_TRUE(hmi.write(200, Words{1, 2}));
  ASSERT_TRUE(hmi.write(0xF70B, 3));
  ASSERT_TRUE(hmi.write(0xF70A, 4));
  EXPECT_THAT(hmi.holding(200, 2), ElementsAre(1, 2));
  EXPECT_EQ(now("D200"), 0);
  line->ask(Advance{2 * millisecond});
  line->until([](const News& news) { return news.time == 2 * millisecond; });
  EXPECT_EQ(now("D200"), 1);
  EXPECT_EQ(now("C205"), 0x30004);
  expect_same_again();
}

TEST_F(ModbusLx3vpLine, ExceptionsSayWhy) {
  begin_plc();
  Hmi hmi(server->port());
  EXPECT_FALSE(hmi.coil(0xF800, true));
  EXPECT_EQ(hmi.error, EMBXILADD) << "inputs are read only";
  EXPECT_TRUE(hmi.holding(8256, 1).empty());
  EXPECT_EQ(hmi.error, EMBXILADD);
  EXPECT_TRUE(hmi.holding(8200, 100).empty());
  EXPECT_EQ(hmi.error, EMBXILADD);
  EXPECT_TRUE(hmi.coils(3072, 1).empty());
  EXPECT_EQ(hmi.error, EMBXILADD);
  EXPECT_FALSE(hmi.write(0xF000, 32768));
  EXPECT_EQ(hmi.error, EMBXILVAL) << "a timer goes to 32767";
  EXPECT_FALSE(hmi.write(0xF0FF, Words{1, 2}));
  EXPECT_EQ(hmi.error, EMBXILADD);
  EXPECT_EQ(now("T255"), 0) << "nothing of it";
  for (const int unit : {1, 0, 255, 17}) {
    hmi.unit(unit);
    EXPECT_EQ(hmi.holding(0, 1).size(), 1U) << unit;
  }
  line->ask(Act{R"({"power": false})"});
  while (!hmi.holding(0, 1).empty()) {
  }
  EXPECT_EQ(hmi.error, EMBXGTAR) << "it has no power";
}

TEST_F(ModbusLx3vpLine, ARestartIsAnotherRunOfTheSameMap) {
  begin_plc();
  Hmi hmi(server->port());
  ASSERT_TRUE(hmi.write(300, 7));
  line->ask(Restart{});
  EXPECT_THAT(hmi.holding(300, 1), ElementsAre(0));
  ASSERT_TRUE(hmi.write(300, 8));
  EXPECT_THAT(hmi.holding(300, 1), ElementsAre(8));
}

TEST_F(ModbusLx3vpLine, FiftyClientsAtOnceEachFindTheirOwn) {
  begin_plc();
  constexpr int clients = 50;
  std::vector<std::thread> threads;
  std::atomic<int> sound = 0;
  threads.reserve(clients);
  for (int client = 0; client < clients; ++client)
    threads.emplace_back([&, client] {
      Hmi hmi(server->port());
      const int address = 1000 + 10 * client;
      for (int round = 0; round < 10; ++round) {
        const Words values(10, static_cast<std::uint16_t>(100 * client + round));
        if (hmi.write(address, values) && hmi.holding(address, 10) == values) ++sound;
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(sound, 10 * clients);
  expect_same_again();
}

namespace asio = boost::asio;
using tcp = asio::ip::tcp;

struct ModbusGarbage : ModbusLx3vpLine {
  ModbusGarbage() { begin_plc(); }
  tcp::socket raw() {
    tcp::socket socket(context);
    socket.connect({asio::ip::make_address("127.0.0.1"), server->port()});
    return socket;
  }
  static void send(tcp::socket& socket, const std::vector<std::uint8_t>& bytes) {
    boost::system::error_code error;
    asio::write(socket, asio::buffer(bytes), error);
  }
  /// Until the server closes.
  static std::vector<std::uint8_t> rest(tcp::socket& socket) {
    std::vector<std::uint8_t> bytes;
    boost::system::error_code error;
    asio::read(socket, asio::dynamic_buffer(bytes), error);
    return bytes;
  }
  void expect_others_served() {
    Hmi hmi(server->port());
    EXPECT_EQ(hmi.holding(0, 10).size(), 10U);
  }
  asio::io_context context;
};

TEST_F(ModbusGarbage, EndsItsConnectionAndNoOther) {
  Hmi hmi(server->port());
  for (const std::vector<std::uint8_t>& bytes :
       {std::vector<std::uint8_t>{'G', 'E', 'T', ' ', '/', '\r', '\n'},
        {0, 1, 0, 7, 0, 6, 1, 3, 0, 0, 0, 1},
        {0, 1, 0, 0, 0, 1, 1},
        std::vector<std::uint8_t>(100'000, 0xFF)}) {
    auto socket = raw();
    send(socket, bytes);
    EXPECT_TRUE(rest(socket).empty());
    EXPECT_EQ(hmi.holding(0, 1).size(), 1U);
  }
}

TEST_F(ModbusGarbage, WhatStandsBeforeItIsAnswered) {
  auto socket = raw();
  send(socket,
       {0, 9, 0, 0, 0, 6, 5, 3, 0, 100, 0, 1, 0, 10, 0, 0, 0, 2, 5, 99, 'x', 'x', 'x', 'x', 'x', 'x'});
  EXPECT_THAT(rest(socket),
              ElementsAre(0, 9, 0, 0, 0, 5, 5, 3, 2, 0xFF, 0xFB, 0, 10, 0, 0, 0, 3, 5, 0xE3, 1));
}

TEST_F(ModbusGarbage, HalfAFrameWaitsAloneAndSoDoesOneThatNeverReads) {
  auto half = raw();
  send(half, {0, 1, 0, 0, 0, 6, 1});
  auto deaf = raw();
  deaf.non_blocking(true);
  std::vector<std::uint8_t> requests;
  for (int i = 0; i < 20'000; ++i) requests.insert(requests.end(), {0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 125});
  boost::system::error_code error;
  deaf.send(asio::buffer(requests), 0, error);
  expect_others_served();
  send(half, {3, 0, 100, 0, 1});
  std::array<std::uint8_t, 11> answer{};
  asio::read(half, asio::buffer(answer));
  EXPECT_EQ(answer.back(), 0xFB) << "it is whole now";
}

TEST_F(ModbusGarbage, OfTooManyConnectionsTheLongestSilentGoes) {
  Hmi old(server->port());
  std::vector<tcp::socket> silent;
  for (int i = 0; i < 63; ++i) {
    silent.push_back(raw());
    send(silent.back(), {0, 1, 0, 0, 0, 6, 1, 3, 0, 100, 0, 1});
    std::array<std::uint8_t, 11> answer{};
    asio::read(silent.back(), asio::buffer(answer));
  }
  EXPECT_EQ(old.holding(0, 1).size(), 1U);
  Hmi next(server->port());
  EXPECT_EQ(next.holding(0, 1).size(), 1U);
  EXPECT_EQ(old.holding(0, 1).size(), 1U) << "it has talked since";
  EXPECT_TRUE(rest(silent.front()).empty()) << "is closed";
}

TEST_F(ModbusGarbage, AClientThatIsGoneWhileTheLineHasItsRequestIsForgotten) {
  for (int i = 0; i < 200; ++i) {
    auto socket = raw();
    send(socket, {0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 125});
    socket.set_option(asio::socket_base::linger(true, 0));
  }
  expect_others_served();
}

struct ModbusQmoveLine : ModbusLine {
  void begin_qmove(const std::string& record = "hmi MODBUS 0002 1\n") {
    folder.file("hmi.cnf", "SYSTEM\nslLength L\nslSpeed W\nGLOBAL\nglSeen L\nINTDEVICE\n" + record + "END\n");
    folder.file(
        "hmi.mod",
        "hmi.mode = 1\nhmi.idcard = 7\nOPENCOM hmi\nWAIT hmi.st_opencom\n"
        "MAIN:\nIF hmi.st_msgrx\n  slLength = hmi.ilong1\n  slSpeed = hmi.iword3\n  glSeen = glSeen + 1\n"
        "  hmi.olong1 = slLength * 2\n  hmi.oword3 = slSpeed + 1\n  RECEIVED hmi\n  WAIT NOT hmi.st_msgrx\n"
        "ENDIF\nWAIT 1\nJUMP MAIN\nEND\n");
  }
  static constexpr const char* scene = R"(scene: {title: Qmove, step: 1 ms, duration: 1000 h}
plants: {bench: {type: bench}}
controller: {qmove: {configuration: hmi.cnf, tasks: [hmi.mod], cycle: 2 ms}}
record: {every: 100 ms, channels: [slLength, slSpeed, glSeen, hmi.olong1]}
)";
};

TEST_F(ModbusQmoveLine, AMasterWritesIwordAndReadsOword) {
  begin_qmove();
  begin(scene);
  Hmi hmi(server->port(), 7);
  while (now("hmi.st_opencom") != 1) {
  }
  ASSERT_TRUE(hmi.write(0, Words{1, 2, 0xFFFF})) << modbus_strerror(hmi.error);
  while (now("hmi.oword3") != 0 || now("glSeen") == 0) {
  }
  EXPECT_EQ(now("slLength"), 0x10002);
  EXPECT_EQ(now("slSpeed"), -1);
  EXPECT_THAT(hmi.holding(0, 3), ElementsAre(2, 4, 0));
  EXPECT_THAT(hmi.input(0, 2), ElementsAre(2, 4));
  EXPECT_THAT(hmi.coils(17, 2), ElementsAre(0, 1)) << "bits 1 and 2 of oword2";
  const double seen = now("glSeen");
  // Two bits of one word, one after the other, before the device has sampled the first.
  ASSERT_TRUE(hmi.coil(500, true));
  ASSERT_TRUE(hmi.coil(501, true));
  while (now("glSeen") == seen) {
  }
  while (now("hmi.iword32") != (3 << 4)) {
  }
  EXPECT_TRUE(hmi.holding(30, 3).empty());
  EXPECT_EQ(hmi.error, EMBXILADD) << "32 words";
  hmi.unit(8);
  EXPECT_TRUE(hmi.holding(0, 1).empty());
  EXPECT_EQ(hmi.error, EMBXGTAR);
  hmi.unit(255);
  EXPECT_EQ(hmi.holding(0, 1).size(), 1U);
  expect_same_again();
}

TEST_F(ModbusQmoveLine, WithoutTheDeviceTheMessageSaysWhatToDeclare) {
  begin_qmove("");
  folder.file("hmi.mod", "END\n");
  cli::LiveOptions options;
  options.scenario =
      folder.file("line.yaml",
                  "scene: {title: Q, step: 1 ms, duration: 1 s}\nplants: {bench: {type: bench}}\n"
                  "controller: {qmove: {configuration: hmi.cnf, tasks: [hmi.mod]}}\n");
  options.modbus = 0;
  EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::bad_input);
  EXPECT_THAT(
      err, HasSubstr("the controller has no Modbus; it takes a device MODBUS in INTDEVICE of the .CNF: hmi "
                     "MODBUS 0002 1"));
  options.scenario = folder.file("web.yaml", web_alone);
  EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("the scenario has none"));
}

struct ModbusPlcopenLine : ModbusLine {
  static constexpr const char* program = R"(PROGRAM hmi
VAR
  start AT %MX1.2 : BOOL;
  count AT %MW4 : INT := -3;
  limit AT %MW5 : UINT;
  way AT %MD4 : DINT;
  speed AT %MD5 : REAL := 1.5;
  exact AT %ML4 : LREAL;
  recipe AT %MW40 : ARRAY [2..4] OF INT := [7, 8, 9];
  plain : DINT := 70000;
  shown : BOOL;
END_VAR
shown := start;
exact := LREAL#2.0 * way;
END_PROGRAM
)";
  static std::string scene(const std::string& map) {
    return "scene: {title: Plcopen, step: 1 ms, duration: 1000 h}\nplants: {bench: {type: bench}}\n"
           "controller:\n  plcopen:\n    program: hmi.st\n" +
           map + "record: {every: 100 ms, channels: [count, way, speed, exact]}\n";
  }
  ModbusPlcopenLine() { folder.file("hmi.st", program); }
};

TEST_F(ModbusPlcopenLine, VariablesInMemoryAndOfTheMapAreThere) {
  begin(scene(R"(    modbus:
      coils: {0: shown}
      discrete_inputs: {3: shown}
      holding_registers: {100: limit, 102: {value: plain, type: int32, words: high_first}}
      input_registers: {200: {value: speed, type: real64}}
)"));
  Hmi hmi(server->port());
  EXPECT_THAT(hmi.holding(4, 2), ElementsAre(0xFFFD, 0));
  EXPECT_THAT(hmi.holding(10, 2), ElementsAre(0, 0x3FC0)) << "speed 1.5, the low word first";
  EXPECT_THAT(hmi.input(40, 3), ElementsAre(7, 8, 9));
  EXPECT_THAT(hmi.holding(0, 4), ElementsAre(0, 0, 0, 0)) << "gaps of the memory";
  EXPECT_FALSE(hmi.write(0, 1));
  EXPECT_EQ(hmi.error, EMBXILADD) << "nothing stands there";
  EXPECT_THAT(hmi.holding(102, 2), ElementsAre(1, 0x1170));
  EXPECT_THAT(hmi.input(200, 4), ElementsAre(0, 0, 0, 0x3FF8));
  EXPECT_TRUE(hmi.holding(104, 1).empty());
  EXPECT_EQ(hmi.error, EMBXILADD) << "behind the last";
  ASSERT_TRUE(hmi.coil(10, true)) << modbus_strerror(hmi.error);
  while (now("shown") != 1) {
  }
  EXPECT_THAT(hmi.inputs(3, 1), ElementsAre(1));
  EXPECT_THAT(hmi.coils(0, 11), ElementsAre(1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1));
  ASSERT_TRUE(hmi.write(8, Words{0x1170, 0xFFFE, 0, 0x4010}));
  while (now("exact") == 0) {
  }
  EXPECT_EQ(now("way"), -126608);
  EXPECT_EQ(now("speed"), 2.25);
  EXPECT_EQ(hmi.holding(16, 4), (Words{0, 0, 0xE900, 0xC10E})) << "-253216 as an LREAL";
  ASSERT_TRUE(hmi.write(100, 65535)) << modbus_strerror(hmi.error);
  EXPECT_THAT(hmi.holding(5, 1), ElementsAre(65535)) << "one variable, two addresses";
  expect_same_again();
}

// While the line stands still, what was written waits for the next step.
TEST_F(ModbusPlcopenLine, WhatWaitsReadsInTheFormatOfEachAddress) {
  begin(scene("    modbus: {input_registers: {200: {value: speed, type: real64}}}\n"), false);
  Hmi hmi(server->port());
  ASSERT_TRUE(hmi.write(10, Words{0, 0x4010})) << modbus_strerror(hmi.error);
  EXPECT_EQ(now("speed"), 1.5);
  EXPECT_THAT(hmi.holding(10, 2), ElementsAre(0, 0x4010)) << "2.25 as a REAL";
  EXPECT_THAT(hmi.input(200, 4), ElementsAre(0, 0, 0, 0x4002)) << "and as an LREAL";
}

TEST_F(ModbusPlcopenLine, WithoutAnyTheMessageSaysWhatToDeclare) {
  folder.file("hmi.st", "PROGRAM p\nVAR x : INT; END_VAR\nx := 1;\nEND_PROGRAM\n");
  cli::LiveOptions options;
  options.scenario = folder.file("line.yaml",
                                 "scene: {title: P, step: 1 ms, duration: 1 s}\nplants: {bench: {type: "
                                 "bench}}\ncontroller: {plcopen: {program: hmi.st}}\n");
  options.modbus = 0;
  EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::bad_input);
  EXPECT_THAT(err, HasSubstr("it takes variables AT %MX0.0, %MW0, %MD0 or %ML0 in the program, or "
                             "controller.plcopen.modbus in the scenario"));
}

TEST_F(ModbusLx3vpLine, APortThatIsTakenEndsTheProgram) {
  begin_plc();
  cli::LiveOptions options;
  options.scenario = folder / "line.yaml";
  options.port = 0;
  options.modbus = server->port();
  EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::bad_input);
  EXPECT_EQ(
      err, fmt::format("--modbus:1:1: cannot listen for Modbus on 127.0.0.1 port {}: Address already in use; "
                       "give another port, or --modbus 0 for any free one [live.cannot-listen]\n",
                       server->port()));
  EXPECT_EQ(out, "");
  options.modbus = {};
  options.port = server->port();
  EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::bad_input);
  EXPECT_THAT(
      err,
      HasSubstr(
          "Address already in use; give another port, or --port 0 for any free one [live.cannot-listen]\n"));
  options.port = 0;
  for (const auto* address : {"192.0.2.1", "nonsense"}) {  // of documents, nobody's
    options.listen = address;
    EXPECT_EQ(captured([&] { return cli::live_scenario(options); }), cli::bad_input);
    EXPECT_THAT(err, testing::StartsWith("--listen:1:1: cannot listen"));
    EXPECT_THAT(err, HasSubstr("an address of this machine"));
  }
}

}  // namespace
}  // namespace drycut::sim::live
