// The device MODBUS of the QMOVE: its tables, its commands, and what a master reaches of it.
#include <gmock/gmock.h>

#include "devices/modbus/modbus.hpp"
#include "devices/qmove/catalogue.hpp"
#include "devices/qmove/qmove_controller.hpp"
#include "tests/test_folder.hpp"

namespace drycut::devices {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct ModbusDevice : testing::Test {
  ModbusDevice() { device->sample(); }
  int get(const std::string& name) const { return device->read(find_symbol(device->type(), name).value()); }
  void set(const std::string& name, int value) const {
    device->write(find_symbol(device->type(), name).value(), value);
    device->sample();
  }
  void give(const std::string& command) const {
    device->command(find_command(device->type(), command).value());
    device->sample();
  }
  std::vector<std::string> refused() const {
    std::vector<std::string> texts;
    for (const auto& said : device->take_diagnostics()) texts.push_back(said.subject + ": " + said.text);
    return texts;
  }

  Cards cards;
  std::unique_ptr<Device> device = modbus::make_modbus({{5, {}}, {1, {}}}, cards);
};

TEST_F(ModbusDevice, RunsFromPowerUpOnAndTakesAnInit) {
  EXPECT_EQ(get("st_init"), 1);
  give("INIT");
  EXPECT_THAT(refused(), ElementsAre());
  EXPECT_EQ(device->period_ms(), 5);
  device->power_up();
  EXPECT_EQ(get("st_init"), 0);
  device->sample();
  EXPECT_EQ(get("st_init"), 1);
}

TEST_F(ModbusDevice, WordsAndLongsAreTheSameTableHighWordFirst) {
  for (const std::string side : {"i", "o"}) {
    set(side + "long2", -2);
    EXPECT_EQ(get(side + "word3"), -1);
    EXPECT_EQ(get(side + "word4"), -2);
    EXPECT_EQ(get(side + "word2"), 0);
    EXPECT_EQ(get(side + "word5"), 0);
    set(side + "word31", 1);
    set(side + "word32", -1);
    EXPECT_EQ(get(side + "long16"), 0x1FFFF);
    set(side + "word4", 5);
    EXPECT_EQ(get(side + "long2"), -65536 + 5);
  }
  EXPECT_EQ(get("ilong16"), get("olong16"));
  set("iword1", 7);
  EXPECT_EQ(get("oword1"), 0) << "two tables";
}

TEST_F(ModbusDevice, TheTablesGoWithPowerTheParametersStay) {
  set("mode", 1);
  set("idcard", 12);
  set("oword1", 3);
  give("OPENCOM");
  device->power_up();
  device->sample();
  EXPECT_EQ(get("mode"), 1);
  EXPECT_EQ(get("idcard"), 12);
  EXPECT_EQ(get("oword1"), 0);
  EXPECT_EQ(get("st_opencom"), 0);
}

TEST_F(ModbusDevice, AMessageIsToldUntilItIsReceived) {
  set("iword1", 1);
  EXPECT_EQ(get("st_msgrx"), 0) << "closed";
  set("mode", 1);
  give("OPENCOM");
  set("oword1", 1);
  EXPECT_EQ(get("st_msgrx"), 0);
  set("iword9", 1);
  EXPECT_EQ(get("st_msgrx"), 1);
  give("RECEIVED");
  EXPECT_EQ(get("st_msgrx"), 0);
  set("ilong3", 1);
  EXPECT_EQ(get("st_msgrx"), 1);
}

TEST_F(ModbusDevice, OpensBeforeItClosesAsTheManualSays) {
  device->command(find_command(device->type(), "CLOSECOM").value());
  give("OPENCOM");
  EXPECT_EQ(get("st_opencom"), 0);
}

TEST_F(ModbusDevice, AMasterFindsNoSlave) {
  give("SEND");
  EXPECT_EQ(get("wcmd"), 1) << "closed";
  give("OPENCOM");
  EXPECT_EQ(get("wcmd"), 0);
  static_cast<void>(refused());
  give("SEND");
  EXPECT_THAT(refused(), ElementsAre("SEND: needs mode = 0, 0 < num <= 128")) << "num is 0";
  set("num", 128);
  give("SEND");
  EXPECT_EQ(get("st_sended"), 0);
  int samples = 1;
  for (; get("st_sended") == 0; ++samples) device->sample();
  EXPECT_EQ(samples * device->period_ms(), 1000);
  EXPECT_EQ(get("err"), 1);
  give("SENDSYC");
  EXPECT_EQ(get("err"), 0);
  set("num", 129);
  EXPECT_EQ(get("wdata"), 1);
  set("num", 1);
  EXPECT_EQ(get("wdata"), 0);
}

// What a .CNF says of it.
struct ModbusCnf : testing::Test {
  std::string told(const std::string& record) {
    problems.clear();
    configuration =
        qmove::parse_configuration("INTDEVICE\n" + record + "\nEND\n", "line.cnf", catalogue(), problems);
    return lines_of(problems);
  }
  Problems problems;
  qmove::Configuration configuration;
  std::int64_t time = 0;
};

TEST_F(ModbusCnf, HasASamplingTimeAndAPort) {
  EXPECT_EQ(told("modbus MODBUS 0002 1"), "");
  EXPECT_EQ(configuration.devices.at(0).resources.at(0).number, 2);
  EXPECT_EQ(configuration.devices.at(0).resources.at(1).number, 1);
  EXPECT_THAT(told("hmi MODBUS 2 10"),
              HasSubstr("line.cnf:2:14: Port of MODBUS cannot be '10'; write the number of "
                        "a communication port, from 0 to 9"));
  EXPECT_THAT(told("hmi MODBUS 0 1"), HasSubstr("line.cnf:2:12: TCamp of MODBUS cannot be '0'"));
  EXPECT_THAT(told("hmi MODBUS 2"), HasSubstr("write: <name> MODBUS TCamp Port"));
  EXPECT_THAT(told("hmi MODBUZ 2 1"), HasSubstr("MODBUS"));
}

TEST_F(ModbusCnf, IsReachedWhileItIsAnOpenSlave) {
  ASSERT_EQ(told("drive MODBUS 4 2\nother MODBUS 2 1"), "");
  qmove::QmoveController controller(configuration, {}, catalogue(), 2'000'000);
  const auto shown = controller.modbus();
  ASSERT_TRUE(std::holds_alternative<const ModbusFace*>(shown));
  const auto& face = *std::get<0>(shown);
  const auto set = [&](const char* name, double value) {
    controller.find(name)->write(value);
    controller.run_devices(time += 4'000'000);
  };
  EXPECT_FALSE(face.answers(3));
  set("drive.idcard", 3);
  set("drive.mode", 2);
  EXPECT_FALSE(face.answers(3)) << "closed";
  const auto command = [&](const char* module) {
    Problems wrong;
    std::vector<qmove::QclProgram> programs;
    programs.push_back(qmove::compile_module(module, "t.mod", configuration, catalogue(), wrong));
    EXPECT_EQ(lines_of(wrong), "");
    return programs;
  };
  qmove::QmoveController open(configuration,
                              command("drive.idcard = 3\ndrive.mode = 1\nOPENCOM drive\nEND\n"), catalogue(),
                              2'000'000);
  const auto& slave = *std::get<0>(open.modbus());
  for (std::int64_t ms = 0; ms < 20; ms += 2) {
    open.run_devices(ms * 1'000'000);
    open.run_tasks(ms * 1'000'000);
  }
  for (const auto& [unit, answers] : {std::pair{3, true}, {0, true}, {255, true}, {4, false}, {1, false}})
    EXPECT_EQ(slave.answers(static_cast<std::uint8_t>(unit)), answers) << unit;
  const auto where = [](const std::optional<ModbusPlace>& place) {
    return place ? place->value + "/" + std::to_string(place->shift) : "";
  };
  using enum ModbusTable;
  EXPECT_EQ(where(slave.read(holding_registers, 0)), "drive.oword1/0");
  EXPECT_EQ(where(slave.read(input_registers, 31)), "drive.oword32/0");
  EXPECT_EQ(where(slave.read(holding_registers, 32)), "");
  EXPECT_EQ(where(slave.written(holding_registers, 6)), "drive.iword7/0");
  EXPECT_EQ(where(slave.read(coils, 17)), "drive.oword2/1");
  EXPECT_EQ(where(slave.written(coils, 511)), "drive.iword32/15");
  EXPECT_EQ(where(slave.read(discrete_inputs, 512)), "");
  EXPECT_EQ(slave.written(coils, 0)->settles_ns, 4'000'000);
  open.power(false);
  EXPECT_FALSE(slave.answers(3));
}

TEST_F(ModbusCnf, WithoutTheDeviceSaysWhatToDeclare) {
  ASSERT_EQ(told(""), "");
  const qmove::QmoveController controller(configuration, {}, catalogue(), 2'000'000);
  EXPECT_THAT(std::get<std::string>(controller.modbus()), HasSubstr("hmi MODBUS 0002 1"));
}

}  // namespace
}  // namespace drycut::devices
