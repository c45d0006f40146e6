// What each controller shows at which Modbus address, beside what is published of it.
#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <map>
#include <string>

#include "devices/controller.hpp"
#include "devices/lx3vp/modbus_map.hpp"
#include "devices/lx3vp/registers.hpp"
#include "devices/plcopen/modbus_map.hpp"

namespace drycut::devices {
namespace {

constexpr std::array all_tables = {ModbusTable::coils, ModbusTable::discrete_inputs,
                                   ModbusTable::holding_registers, ModbusTable::input_registers};

TEST(ModbusFormats, LieInBitsAndComeBack) {
  struct Row {
    ModbusFormat format;
    double value;
    std::uint64_t bits;
  };
  for (const auto& [format, value, bits] : {Row{ModbusFormat::bit, 1, 1},
                                            {ModbusFormat::int16, -2, 0xFFFE},
                                            {ModbusFormat::uint16, 65534, 0xFFFE},
                                            {ModbusFormat::int32, -100000, 0xFFFE7960},
                                            {ModbusFormat::uint32, 4294867296.0, 0xFFFE7960},
                                            {ModbusFormat::real32, -1.5, 0xBFC00000},
                                            {ModbusFormat::real64, -1.5, 0xBFF8000000000000}}) {
    EXPECT_EQ(to_bits(format, value), bits);
    EXPECT_EQ(from_bits(format, bits), value);
  }
}

TEST(ModbusFormats, TakeTheNearestOfWhatTheyCannotHold) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(from_bits(ModbusFormat::int16, to_bits(ModbusFormat::int16, 1e9)), 32767);
  EXPECT_EQ(from_bits(ModbusFormat::int16, to_bits(ModbusFormat::int16, -1e9)), -32768);
  EXPECT_EQ(from_bits(ModbusFormat::uint16, to_bits(ModbusFormat::uint16, -1)), 0);
  EXPECT_EQ(from_bits(ModbusFormat::int32, to_bits(ModbusFormat::int32, 2.5e9)), 2147483647);
  EXPECT_EQ(from_bits(ModbusFormat::int16, to_bits(ModbusFormat::int16, 2.6)), 3);
  EXPECT_EQ(from_bits(ModbusFormat::real32, to_bits(ModbusFormat::real32, 1e300)),
            static_cast<double>(std::numeric_limits<float>::max()));
  for (const auto format : {ModbusFormat::bit, ModbusFormat::int32, ModbusFormat::real64})
    EXPECT_EQ(to_bits(format, nan), 0U);
}

/// "D7", "C200/16": the value and where in it; "" where nothing is.
std::string at(const ModbusFace& face, ModbusTable table, int address, bool writing = false) {
  const auto number = static_cast<std::uint16_t>(address);
  const auto place = writing ? face.written(table, number) : face.read(table, number);
  if (!place) return "";
  return place->shift == 0 ? place->value : place->value + "/" + std::to_string(place->shift);
}

TEST(ModbusLx3vp, BeginsAndEndsEachRangeWhereWeconSays) {
  constexpr bool on = true;
  const lx3vp::RegisterFace map(on);
  struct Row {
    int address;
    const char* name;
  };
  for (const auto table : {ModbusTable::coils, ModbusTable::discrete_inputs})
    for (const auto& [address, name] :
         {Row{0, "M0"},      {3071, "M3071"},  {3072, ""},       {7999, ""},        {8000, "M8000"},
          {8034, "M8034"},   {8035, ""},       {8255, "M8255"},  {8256, ""},        {0xDFFF, ""},
          {0xE000, "S0"},    {0xE3E7, "S999"}, {0xE3E8, ""},     {0xEFFF, ""},      {0xF000, "TS0"},
          {0xF0FF, "TS255"}, {0xF100, ""},     {0xF400, "CS0"},  {0xF4FF, "CS255"}, {0xF500, ""},
          {0xF800, "X0"},    {0xF807, "X7"},   {0xF808, "X10"},  {0xF8FF, "X377"},  {0xF900, ""},
          {0xFC00, "Y0"},    {0xFC08, "Y10"},  {0xFCFF, "Y377"}, {0xFD00, ""},      {0xFFFF, ""}})
      EXPECT_EQ(at(map, table, address), name) << address;
  for (const auto table : {ModbusTable::holding_registers, ModbusTable::input_registers})
    for (const auto& [address, name] :
         {Row{0, "D0"},     {7999, "D7999"},  {8010, "D8010"},     {8255, ""},       {8256, ""},
          {0xEFFF, ""},     {0xF000, "T0"},   {0xF0FF, "T255"},    {0xF100, ""},     {0xF400, "C0"},
          {0xF4C7, "C199"}, {0xF4C8, ""},     {0xF6FF, ""},        {0xF700, "C200"}, {0xF701, "C200/16"},
          {0xF702, "C201"}, {0xF76E, "C255"}, {0xF76F, "C255/16"}, {0xF770, ""},     {0xFFFF, ""}})
      EXPECT_EQ(at(map, table, address), name) << address;
}

TEST(ModbusLx3vp, HasEveryRegisterOnceAndWritesAllButInputs) {
  constexpr bool on = true;
  const lx3vp::RegisterFace map(on);
  std::map<std::string, int> seen;
  for (const auto table : {ModbusTable::coils, ModbusTable::holding_registers})
    for (int address = 0; address < 65536; ++address) {
      const auto name = at(map, table, address);
      if (name.empty()) continue;
      EXPECT_EQ(++seen[name], 1) << name;
      EXPECT_TRUE(lx3vp::parse_register(name.substr(0, name.find('/')))) << name;
      EXPECT_EQ(at(map, table, address, true), name[0] == 'X' ? "" : name);
    }
  // Of the special relays and registers those that are simulated have a name; all of them answer.
  std::size_t silent = 0;
  for (int number = lx3vp::first_special; number < lx3vp::first_special + 256; ++number)
    for (const auto& [letter, table] :
         {std::pair('M', ModbusTable::coils), {'D', ModbusTable::holding_registers}}) {
      EXPECT_TRUE(map.read(table, static_cast<std::uint16_t>(number))) << letter << number;
      EXPECT_EQ(map.written(table, static_cast<std::uint16_t>(number)).has_value(),
                lx3vp::is_served(letter, number))
          << letter << number;
      if (!lx3vp::is_served(letter, number)) ++silent;
    }
  // M, S, T and C contacts, X, Y; D, T, C below 200, two words of each above.
  EXPECT_EQ(seen.size() + silent, 3072U + 256 + 1000 + 256 + 256 + 256 + 256 + 8256 + 256 + 200 + 2 * 56);
}

TEST(ModbusLx3vp, AnswersAsAnyUnitWhileItHasPower) {
  bool powered = true;
  const lx3vp::RegisterFace map(powered);
  for (const int unit : {0, 1, 247, 255}) EXPECT_TRUE(map.answers(static_cast<std::uint8_t>(unit)));
  powered = false;
  EXPECT_FALSE(map.answers(1));
}

TEST(ModbusMemory, PlacesCountInTheirOwnSize) {
  using plcopen::parse_memory_place;
  for (const auto& [text, number] : {std::pair{"%MX0.0", 0},
                                     {"%mx3.5", 29},
                                     {"%MX8191.7", 65535},
                                     {"%MW0", 0},
                                     {"%MW65535", 65535},
                                     {"%MD10", 10},
                                     {"%MD32767", 32767},
                                     {"%ml16383", 16383}}) {
    const auto place = parse_memory_place(text);
    ASSERT_TRUE(place) << text;
    EXPECT_EQ(place->number, number);
  }
  for (const auto* text : {"%MX0", "%MX0.8", "%MX8192.0", "%MW65536", "%MD32768", "%ML16384", "%MB0", "%MW",
                           "%MW-1", "%MW1.2", "%MW1x", "%IX0.0", "MW0", "%MX0.-1", "%MX0.0.0", ""})
    EXPECT_FALSE(parse_memory_place(text)) << text;
  for (const auto* text : {"%MX3.5", "%MW10", "%MD7", "%ML2"})
    EXPECT_EQ(to_string(*parse_memory_place(text)), text);
}

TEST(ModbusMemory, HasGapsThatReadZeroAndCannotBeWritten) {
  bool powered = true;
  plcopen::MemoryFace map(powered);
  EXPECT_TRUE(map.empty());
  EXPECT_EQ(map.add(ModbusTable::holding_registers, 4, "a", ModbusFormat::int16, true), "");
  EXPECT_EQ(map.add(ModbusTable::holding_registers, 6, "b", ModbusFormat::real32, true), "");
  EXPECT_EQ(map.add(ModbusTable::holding_registers, 8, "c", ModbusFormat::real64, false), "");
  EXPECT_EQ(map.add(ModbusTable::holding_registers, 3, "d", ModbusFormat::int32, true), "a") << "is taken";
  const auto table = ModbusTable::holding_registers;
  std::string row;
  for (int address = 0; address < 13; ++address) row += at(map, table, address) + ",";
  EXPECT_EQ(row, ",,,,a,,b,b/16,c/48,c/32,c/16,c,,");
  EXPECT_TRUE(map.read(table, 3)) << "a gap";
  EXPECT_FALSE(map.written(table, 3));
  EXPECT_TRUE(map.written(table, 7));
  EXPECT_FALSE(map.read(table, 12)) << "behind the last";
  for (const auto other : all_tables) {
    if (other != table) {
      EXPECT_FALSE(map.read(other, 0));
    }
  }
  EXPECT_TRUE(map.answers(17));
  powered = false;
  EXPECT_FALSE(map.answers(17));
}

}  // namespace
}  // namespace drycut::devices
