#include "devices/device.hpp"

#include <gmock/gmock.h>

#include <array>

namespace drycut::devices {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

enum State { st_init, st_busy, st_kept };
enum Value { level, byte, shown, flag, table };
enum FakeCommand { c_INIT, c_FIRST, c_SECOND, c_QUIET };

constexpr std::array variables = {
    DeviceVariable{"level", Size::L, "Um", -100, 100},
    DeviceVariable{"byte", Size::B, "", -128, 127, Access::read_write, Retention::zero, {0b10, 0b00}},
    DeviceVariable{"shown", Size::L, "", 0, 0, Access::read},
    DeviceVariable{"flag", Size::F, "", 0, 1, Access::read_write, Retention::one},
    DeviceVariable{"code",
                   Size::W,
                   "",
                   0,
                   9,
                   Access::read_write,
                   Retention::retentive,
                   {0, 0, "a free row"},
                   "",
                   "",
                   12},
};
constexpr std::array states = {devices::State{"st_init"}, devices::State{"st_busy"},
                               devices::State{"st_kept", Retention::retentive}};
constexpr std::array commands = {
    devices::DeviceCommand{"INIT", {0b1, 0}}, devices::DeviceCommand{"FIRST", {0b11, 0b01}},
    devices::DeviceCommand{"SECOND", {0b11, 0b11}},
    devices::DeviceCommand{"QUIET", {0b11, 0b11}, "", "", {st_kept, true, true}}};
constexpr std::array aliases = {Alias{"lvl", "level"}, Alias{"lost", "nothing"}};
const DeviceType fake_type = {"FAKE", "", variables, states, commands, {}, aliases};

/// Writes down what the base asks of it.
class Fake : public Device {
 public:
  Fake() : Device(fake_type) {}
  std::vector<std::string> log;
  int blocked_row = -1;

  [[nodiscard]] int period_ms() const override { return 1; }

 protected:
  void latch() override { log.emplace_back("latch"); }
  void initialise() override { log.emplace_back("initialise"); }
  void execute(int command) override {
    log.emplace_back(fake_type.commands[command].name);
    if (command == c_FIRST) set_state(st_busy, true);
    if (command == c_SECOND) set_state(st_kept, true);
  }
  void step() override { log.emplace_back("step"); }
  bool may_write(Symbol symbol, std::int32_t) override {
    return symbol.index != table || symbol.row != blocked_row;
  }
  void refused(int command) override {
    log.push_back("refused " + std::string(fake_type.commands[command].name));
  }
};

Symbol variable(int index, int row = 0) { return {Symbol::Kind::variable, index, row}; }
Symbol flag_of(int index) { return {Symbol::Kind::state, index, 0}; }

std::vector<std::string> texts(Device& device) {
  std::vector<std::string> result;
  for (const Diagnostic& diagnostic : device.take_diagnostics())
    result.push_back(diagnostic.subject + ": " + diagnostic.text);
  return result;
}

void initialise(Fake& fake) {
  fake.command(c_INIT);
  fake.sample();
  fake.log.clear();
}

TEST(DeviceLookup, FindsNamesInAnyCaseRowsAndAliases) {
  EXPECT_EQ(find_symbol(fake_type, "LEVEL")->index, level);
  EXPECT_EQ(find_symbol(fake_type, "lvl")->index, level);
  EXPECT_EQ(find_symbol(fake_type, "Code12")->row, 11);
  EXPECT_EQ(find_symbol(fake_type, "st_BUSY")->kind, Symbol::Kind::state);
  EXPECT_EQ(*find_command(fake_type, "first"), c_FIRST);
}

TEST(DeviceLookup, KnowsNothingElse) {
  for (const char* name : {"code", "code0", "code13", "code-1", "code1x", "lost", "", "levels"})
    EXPECT_FALSE(find_symbol(fake_type, name)) << name;
  EXPECT_FALSE(find_command(fake_type, "FIRS"));
}

TEST(DeviceLookup, NamesRoundTrip) {
  EXPECT_EQ(name_of(fake_type, variable(table, 11)), "code12");
  EXPECT_EQ(name_of(fake_type, flag_of(st_busy)), "st_busy");
  EXPECT_THAT(symbol_names(fake_type),
              ElementsAre("level", "byte", "shown", "flag", "code1", "st_init", "st_busy", "st_kept"));
}

TEST(DeviceWrap, WrapsAsAStoreDoes) {
  EXPECT_EQ(wrap(Size::B, 128), -128);
  EXPECT_EQ(wrap(Size::B, -129), 127);
  EXPECT_EQ(wrap(Size::W, 32768), -32768);
  EXPECT_EQ(wrap(Size::L, std::int64_t{1} << 31), -2147483648LL);
  EXPECT_EQ(wrap(Size::F, -5), 1);
  EXPECT_EQ(wrap(Size::F, 0), 0);
}

TEST(DeviceMailbox, BeforeInitWritesActAtOnceAndNothingElseHappens) {
  Fake fake;
  fake.write(variable(level), 7);
  EXPECT_EQ(fake.read(variable(level)), 7);
  EXPECT_TRUE(fake.settled());
  fake.command(c_FIRST);
  EXPECT_TRUE(fake.settled());
  fake.sample();
  EXPECT_THAT(fake.log, ElementsAre("latch"));
  EXPECT_THAT(texts(fake), ElementsAre("FIRST: st_init is 0, must be 1"));
}

TEST(DeviceMailbox, InitStartsItAndOnlyOnce) {
  Fake fake;
  fake.command(c_INIT);
  fake.sample();
  EXPECT_EQ(fake.read(flag_of(st_init)), 1);
  EXPECT_THAT(fake.log, ElementsAre("latch", "initialise", "step"));
  fake.command(c_INIT);
  fake.sample();
  EXPECT_THAT(texts(fake), ElementsAre("INIT: st_init is 1, must be 0"));
}

TEST(DeviceMailbox, WritesWaitForTheSampleThenComeBeforeCommands) {
  Fake fake;
  initialise(fake);
  fake.command(c_FIRST);
  fake.write(variable(byte), 3);
  EXPECT_FALSE(fake.settled());
  EXPECT_EQ(fake.read(variable(byte)), 0);
  fake.sample();
  EXPECT_TRUE(fake.settled());
  EXPECT_EQ(fake.read(variable(byte)), 3);  // st_busy was still 0
  EXPECT_THAT(texts(fake), IsEmpty());
}

TEST(DeviceMailbox, PendingCommandsAreASetInTableOrder) {
  Fake fake;
  initialise(fake);
  fake.command(c_SECOND);
  fake.command(c_FIRST);
  fake.command(c_FIRST);
  fake.sample();
  EXPECT_THAT(fake.log, ElementsAre("latch", "FIRST", "SECOND", "step"));
}

TEST(DeviceConditions, AFailedConditionIsNamed) {
  Fake fake;
  initialise(fake);
  fake.command(c_SECOND);
  fake.sample();
  EXPECT_THAT(fake.log, ElementsAre("latch", "refused SECOND", "step"));
  EXPECT_THAT(texts(fake), ElementsAre("SECOND: st_busy is 0, must be 1"));
  fake.command(c_FIRST);
  fake.sample();
  fake.write(variable(byte), 9);
  fake.sample();
  EXPECT_THAT(texts(fake), ElementsAre("byte: st_busy is 1, must be 0"));
  EXPECT_EQ(fake.read(variable(byte)), 0);
}

TEST(DeviceConditions, ACommandWhoseEffectHoldsIsSilent) {
  Fake fake;
  initialise(fake);
  fake.command(c_QUIET);
  fake.sample();
  EXPECT_THAT(texts(fake), ElementsAre("QUIET: st_busy is 0, must be 1"));
  EXPECT_EQ(fake.read(flag_of(st_kept)), 0);
  fake.command(c_FIRST);
  fake.command(c_QUIET);
  fake.sample();
  EXPECT_THAT(fake.log, ElementsAre("latch", "refused QUIET", "step", "latch", "FIRST", "QUIET", "step"));
  EXPECT_EQ(fake.read(flag_of(st_kept)), 1);
  fake.log.clear();
  fake.command(c_QUIET);
  fake.sample();
  EXPECT_THAT(fake.log, ElementsAre("latch", "step"));
  EXPECT_FALSE(fake.has_diagnostics());
}

TEST(DeviceConditions, ARequirementThatIsNoStateIsNamedToo) {
  Fake fake;
  fake.blocked_row = 2;
  fake.write(variable(table, 2), 5);
  EXPECT_THAT(texts(fake), ElementsAre("code3: needs a free row"));
  fake.write(variable(table, 3), 5);
  EXPECT_EQ(fake.read(variable(table, 3)), 5);
  EXPECT_EQ(fake.read(variable(table, 2)), 0);
}

TEST(DeviceRanges, ValuesOutOfRangeAreTakenAndReported) {
  Fake fake;
  fake.write(variable(level), 100);
  EXPECT_FALSE(fake.has_diagnostics());
  fake.write(variable(level), 101);
  EXPECT_EQ(fake.read(variable(level)), 101);
  EXPECT_THAT(texts(fake), ElementsAre("level: 101 is outside -100..100, taken anyway"));
  fake.write(variable(byte), 200);
  EXPECT_EQ(fake.read(variable(byte)), -56);
  EXPECT_THAT(texts(fake), ElementsAre("byte: 200 does not fit size B, taken as -56"));
}

TEST(DeviceRanges, ReadOnlyThingsStay) {
  Fake fake;
  fake.write(variable(shown), 1);
  fake.write(flag_of(st_busy), 1);
  EXPECT_EQ(fake.read(variable(shown)), 0);
  EXPECT_EQ(fake.read(flag_of(st_busy)), 0);
  EXPECT_THAT(texts(fake), ElementsAre("shown: read only", "st_busy: read only"));
}

TEST(DevicePower, KeepsWhatIsRetentiveOnly) {
  Fake fake;
  fake.write(variable(level), 5);
  initialise(fake);
  fake.write(variable(byte), 6);
  fake.write(variable(flag), 0);
  fake.sample();
  fake.command(c_FIRST);
  fake.command(c_SECOND);
  fake.sample();
  fake.command(c_SECOND);
  fake.power_up();
  EXPECT_EQ(fake.read(variable(level)), 5);
  EXPECT_EQ(fake.read(variable(byte)), 0);
  EXPECT_EQ(fake.read(variable(flag)), 1);
  EXPECT_EQ(fake.read(flag_of(st_kept)), 1);
  EXPECT_EQ(fake.read(flag_of(st_init)), 0);
  fake.sample();
  EXPECT_FALSE(fake.has_diagnostics());  // the pending command is gone
}

TEST(DevicePower, RestoresRetentiveMemoryOnly) {
  Fake fake;
  fake.restore(variable(level), 44);
  fake.restore(variable(byte), 44);
  fake.restore(flag_of(st_kept), 1);
  fake.restore(flag_of(st_busy), 1);
  EXPECT_EQ(fake.read(variable(level)), 44);
  EXPECT_EQ(fake.read(variable(byte)), 0);
  EXPECT_EQ(fake.read(flag_of(st_kept)), 1);
  EXPECT_EQ(fake.read(flag_of(st_busy)), 0);
}

}  // namespace
}  // namespace drycut::devices
