// Modbus without a socket: every function, every exception, and bytes that are no frame.
#include "sim/live/modbus/face_data.hpp"
#include "sim/live/modbus/frames.hpp"

#include <gmock/gmock.h>

#include <map>

#include "devices/plcopen/modbus_map.hpp"

namespace drycut::sim::live::modbus {
namespace {

using devices::ModbusFormat;
using devices::ModbusTable;
using testing::ElementsAre;

/// Sixteen addresses of each table; coil and register 13 cannot be written, those of 14 take 0 to 100.
struct SmallData : Data {
  Exception read(ModbusTable table, std::uint16_t address, std::span<std::uint16_t> given) override {
    if (address + given.size() > 16) return Exception::illegal_data_address;
    for (auto& value : given) value = values[{table, address++}];
    return Exception::none;
  }
  Exception write(ModbusTable table, std::uint16_t address, std::span<const std::uint16_t> given,
                  std::uint16_t mask) override {
    if (address + given.size() > 16) return Exception::illegal_data_address;
    if (address <= 13 && address + given.size() > 13) return Exception::illegal_data_address;
    for (auto value : given) {
      auto& old = values[{table, address++}];
      old = static_cast<std::uint16_t>((old & ~mask) | (value & mask));
    }
    return Exception::none;
  }
  std::map<std::pair<ModbusTable, int>, std::uint16_t> values;
};

Bytes bytes(std::initializer_list<int> list) {
  Bytes all;
  for (const int byte : list) all.push_back(static_cast<std::uint8_t>(byte));
  return all;
}

TEST(ModbusFrames, AnswerEachFunctionAsTheStandardsExamples) {
  SmallData data;
  for (int i = 0; i < 16; ++i) {
    data.values[{ModbusTable::coils, i}] = i % 3 == 0;
    data.values[{ModbusTable::discrete_inputs, i}] = 1;
    data.values[{ModbusTable::holding_registers, i}] = static_cast<std::uint16_t>(0x0102 * i);
    data.values[{ModbusTable::input_registers, i}] = static_cast<std::uint16_t>(0xFF00 + i);
  }
  struct Row {
    std::initializer_list<int> request;
    std::initializer_list<int> answer;
  };
  for (const auto& [request, wanted] :
       {Row{{1, 0, 0, 0, 10}, {1, 2, 0x49, 0x02}},
        {{2, 0, 3, 0, 1}, {2, 1, 1}},
        {{3, 0, 1, 0, 2}, {3, 4, 0x01, 0x02, 0x02, 0x04}},
        {{4, 0, 15, 0, 1}, {4, 2, 0xFF, 0x0F}},
        {{5, 0, 1, 0xFF, 0}, {5, 0, 1, 0xFF, 0}},
        {{5, 0, 0, 0, 0}, {5, 0, 0, 0, 0}},
        {{1, 0, 0, 0, 2}, {1, 1, 2}},
        {{6, 0, 2, 0x12, 0x34}, {6, 0, 2, 0x12, 0x34}},
        {{15, 0, 4, 0, 9, 2, 0x55, 1}, {15, 0, 4, 0, 9}},
        {{1, 0, 4, 0, 9}, {1, 2, 0x55, 1}},
        {{16, 0, 3, 0, 2, 4, 0, 7, 0, 8}, {16, 0, 3, 0, 2}},
        {{3, 0, 2, 0, 3}, {3, 6, 0x12, 0x34, 0, 7, 0, 8}},
        // 0x12 with AND 0xF2 and OR 0x25 is 0x17 (§6.16).
        {{6, 0, 4, 0, 0x12}, {6, 0, 4, 0, 0x12}},
        {{22, 0, 4, 0, 0xF2, 0, 0x25}, {22, 0, 4, 0, 0xF2, 0, 0x25}},
        {{3, 0, 4, 0, 1}, {3, 2, 0, 0x17}},
        // Written before it is read.
        {{23, 0, 2, 0, 2, 0, 3, 0, 1, 2, 0xAB, 0xCD}, {23, 4, 0x12, 0x34, 0xAB, 0xCD}}})
    EXPECT_EQ(answer(bytes(request), data), bytes(wanted)) << *request.begin();
}

TEST(ModbusFrames, RefuseWhatTheStandardRefuses) {
  SmallData data;
  struct Row {
    Bytes request;
    int exception;
  };
  const auto with = [](std::initializer_list<int> head, std::size_t values) {
    auto all = bytes(head);
    all.resize(all.size() + values);
    return all;
  };
  const std::vector<Row> rows = {
      {bytes({0}), 1},
      {bytes({7}), 1},
      {bytes({43, 14, 1, 0}), 1},
      {bytes({99, 0, 0}), 1},
      {bytes({0x83, 0, 0, 0, 1}), 1},
      // Quantities before addresses (§7).
      {bytes({1, 0, 0, 0, 0}), 3},
      {bytes({1, 0xFF, 0, 0x07, 0xD1}), 3},
      {bytes({1, 0, 0, 0x07, 0xD0}), 2},
      {bytes({2, 0, 0, 0x07, 0xD1}), 3},
      {bytes({3, 0, 0, 0, 0}), 3},
      {bytes({3, 0, 0, 0, 126}), 3},
      {bytes({3, 0, 0, 0, 125}), 2},
      {bytes({4, 0, 0, 0, 126}), 3},
      {bytes({3, 0, 15, 0, 2}), 2},
      {bytes({3, 0xFF, 0xFF, 0, 2}), 2},
      {bytes({1, 0xFF, 0xFF, 0, 2}), 2},
      {bytes({3, 0, 0, 0}), 3},
      {bytes({3, 0, 0, 0, 1, 0}), 3},
      {bytes({5, 0, 0, 0, 1}), 3},
      {bytes({5, 0, 0, 0xFF, 0xFF}), 3},
      {bytes({5, 0, 13, 0xFF, 0}), 2},
      {bytes({5, 0, 0, 0xFF}), 3},
      {bytes({6, 0, 13, 0, 1}), 2},
      {bytes({6, 0, 16, 0, 1}), 2},
      {bytes({6, 0, 0, 0}), 3},
      {bytes({15, 0, 0, 0, 0, 0}), 3},
      {bytes({15, 0, 0, 0, 9, 1, 1}), 3},
      {bytes({15, 0, 0, 0, 8, 2, 1, 1}), 3},
      {bytes({15, 0, 0, 0, 8, 1}), 3},
      {bytes({15, 0, 0}), 3},
      {with({15, 0, 0, 0x07, 0xB1, 247}, 247), 3},
      {with({15, 0, 0, 0x07, 0xB0, 246}, 246), 2},
      {with({16, 0, 0, 0, 124, 248}, 248), 3},
      {with({16, 0, 0, 0, 123, 246}, 246), 2},
      {bytes({16, 0, 0, 0, 1, 2, 0}), 3},
      {bytes({16, 0, 0, 0, 1, 3, 0, 1}), 3},
      {bytes({16, 0, 12, 0, 2, 4, 0, 1, 0, 1}), 2},
      {bytes({22, 0, 13, 0, 0, 0, 1}), 2},
      {bytes({22, 0, 1, 0, 0}), 3},
      {with({23, 0, 0, 0, 126, 0, 0, 0, 1, 2}, 2), 3},
      {with({23, 0, 0, 0, 0, 0, 0, 0, 1, 2}, 2), 3},
      {with({23, 0, 0, 0, 1, 0, 0, 0, 122, 244}, 244), 3},
      {with({23, 0, 0, 0, 1, 0, 0, 0, 1, 4}, 2), 3},
      {with({23, 0, 0, 0, 1, 0, 13, 0, 1, 2}, 2), 2},
      {with({23, 0, 16, 0, 1, 0, 0, 0, 1, 2}, 2), 2},
      {with({23, 0, 0, 0, 1, 0xFF, 0xFF, 0, 2, 4}, 4), 2},
      {bytes({23, 0, 0}), 3},
  };
  for (const auto& [request, exception] : rows) {
    SCOPED_TRACE(testing::PrintToString(request));
    EXPECT_EQ(answer(request, data), bytes({request[0] | 0x80, exception}));
  }
  EXPECT_TRUE(std::all_of(data.values.begin(), data.values.end(), [](const auto& one) {
    return one.second == 0;
  })) << "nothing was written";
  EXPECT_EQ(answer({}, data), bytes({0x80, 1}));
}

TEST(ModbusFrames, ComeOutOfTheBytesHoweverTheyCome) {
  const ModbusFrame one{0x1234, 17, bytes({3, 0, 1, 0, 2})};
  const auto sent = bytes_of(one);
  EXPECT_THAT(sent, ElementsAre(0x12, 0x34, 0, 0, 0, 6, 17, 3, 0, 1, 0, 2));
  Bytes two = sent;
  two.insert(two.end(), sent.begin(), sent.end());
  for (std::size_t piece = 1; piece <= two.size(); ++piece) {
    FrameReader reader;
    int frames = 0;
    for (std::size_t at = 0; at < two.size(); at += piece) {
      reader.take(std::span(two).subspan(at, std::min(piece, two.size() - at)));
      while (const auto frame = reader.next()) {
        ++frames;
        EXPECT_EQ(frame->transaction, one.transaction);
        EXPECT_EQ(frame->unit, one.unit);
        EXPECT_EQ(frame->pdu, one.pdu);
      }
    }
    EXPECT_EQ(frames, 2) << piece;
    EXPECT_FALSE(reader.begun());
  }
}

TEST(ModbusFrames, EndWhereTheBytesAreNone) {
  for (const auto& wrong : {bytes({0, 1, 0, 1, 0, 6}), bytes({0, 1, 0, 0, 0, 1}), bytes({0, 1, 0, 0, 0, 255}),
                            bytes({0, 1, 0, 0, 1, 0}), bytes({'G', 'E', 'T', ' ', '/', ' '})}) {
    FrameReader reader;
    reader.take(wrong);
    EXPECT_FALSE(reader.next());
    EXPECT_TRUE(reader.broken());
  }
  FrameReader whole;
  auto longest = bytes({0, 1, 0, 0, 0, 254, 1});
  longest.resize(260);
  whole.take(longest);
  EXPECT_EQ(whole.next()->pdu.size(), 253U);
}

TEST(ModbusFrames, CostWhatTheyAreAbout) {
  EXPECT_EQ(cost_of(bytes({1, 0, 0, 0x07, 0xD0})), 2000U);
  EXPECT_EQ(cost_of(bytes({1, 0, 0, 0xFF, 0xFF})), 2000U);
  EXPECT_EQ(cost_of(bytes({3, 0, 0, 0, 123})), 123U);
  // One write of all that fits is half of what is looked at between two cycles.
  EXPECT_EQ(cost_of(bytes({16, 0, 0, 0, 123})), 8 * 123U);
  EXPECT_EQ(cost_of(bytes({6, 0, 0, 0, 1})), 8U);
  EXPECT_EQ(cost_of(bytes({3})), 1U);
  EXPECT_EQ(cost_of(bytes({23, 0, 0, 0, 1, 0})), 125U + 8 * 121U);
}

/// A controller of two numbers that takes what it is given in its next step.
struct TwoNumbers : testing::Test {
  TwoNumbers() {
    const auto table = ModbusTable::holding_registers;
    map.add(table, 0, "wide", ModbusFormat::int32, true);
    map.add(table, 2, "real", ModbusFormat::real32, false);
    map.add(table, 4, "shown", ModbusFormat::int16, true);
    map.add(table, 5, "gone", ModbusFormat::int16, true);
  }
  Exception write(int address, std::vector<std::uint16_t> words, int mask = 0xFFFF) {
    return data.write(ModbusTable::holding_registers, static_cast<std::uint16_t>(address), words,
                      static_cast<std::uint16_t>(mask));
  }
  std::vector<int> read(int address, std::size_t count) {
    std::vector<std::uint16_t> words(count);
    EXPECT_EQ(data.read(ModbusTable::holding_registers, static_cast<std::uint16_t>(address), words),
              Exception::none);
    return {words.begin(), words.end()};
  }
  void step() {
    ++now;
    for (const auto& [name, number] : std::exchange(given, {})) numbers[name] = number;
  }

  bool powered = true;
  devices::plcopen::MemoryFace map{powered};
  std::map<std::string, double> numbers{{"wide", 0x10002}, {"real", 1.5}, {"shown", 7}};
  std::vector<std::pair<std::string, double>> given;
  int acts = 0;
  Time now = 0;
  FaceData data{map,
                {[this](const std::string& name) -> std::optional<devices::ControllerValue> {
                   if (!numbers.contains(name)) return {};
                   devices::ControllerValue value{name, "", [this, name] { return numbers[name]; }, {}, {}};
                   if (name != "shown") value.write = [](double) {};
                   return value;
                 },
                 [this](const auto& values) {
                   for (const auto& [name, number] : values)
                     if (number > 1e9) return false;
                   ++acts;
                   given.insert(given.end(), values.begin(), values.end());
                   return true;
                 },
                 [this] { return now; }}};
};

TEST_F(TwoNumbers, HalvesOfANumberAreWrittenOneByOneBetweenTwoSteps) {
  EXPECT_THAT(read(0, 4), ElementsAre(2, 1, 0x3FC0, 0));
  EXPECT_EQ(write(0, {5}), Exception::none);
  EXPECT_EQ(write(1, {6}), Exception::none);
  EXPECT_THAT(read(0, 2), ElementsAre(5, 6)) << "as written, though not taken";
  EXPECT_EQ(numbers["wide"], 0x10002);
  step();
  EXPECT_EQ(numbers["wide"], 0x60005);
  numbers["wide"] = 3;
  EXPECT_THAT(read(0, 2), ElementsAre(3, 0)) << "what the program makes of it";
}

TEST_F(TwoNumbers, OneRequestIsOneAct) {
  EXPECT_EQ(write(0, {1, 2, 0xC000, 0}), Exception::none);
  EXPECT_EQ(acts, 1);
  EXPECT_THAT(given, ElementsAre(std::pair<std::string, double>("wide", 0x20001),
                                 std::pair<std::string, double>("real", -2.0)));
  EXPECT_EQ(write(1, {0x00F0}, 0x00FF), Exception::none);
  EXPECT_EQ(given.back(), (std::pair<std::string, double>("wide", 0x00F00001)));
}

TEST_F(TwoNumbers, AllOfARequestIsTakenOrNothing) {
  EXPECT_EQ(write(2, {0x7F80, 0}), Exception::illegal_data_value) << "infinite";
  EXPECT_EQ(write(2, {0x7FC0, 0}), Exception::illegal_data_value) << "no number";
  EXPECT_EQ(write(1, {0x7000}), Exception::illegal_data_value) << "too much for it";
  EXPECT_EQ(write(4, {1}), Exception::illegal_data_address) << "is only shown";
  EXPECT_EQ(write(3, {0, 1}), Exception::illegal_data_address);
  EXPECT_EQ(write(5, {1}), Exception::illegal_data_address) << "is no more";
  EXPECT_EQ(write(6, {1}), Exception::illegal_data_address);
  EXPECT_EQ(acts, 0);
  EXPECT_THAT(read(4, 1), ElementsAre(7));
}

}  // namespace
}  // namespace drycut::sim::live::modbus
