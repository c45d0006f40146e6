#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/fuzz/device_commands.hpp"

namespace drycut::fuzz {
namespace {

// Under `make sanitize` these find undefined arithmetic; always, what breaks a law of the devices.
class DeviceCommands : public testing::TestWithParam<int> {
 protected:
  [[nodiscard]] const devices::CatalogueEntry& entry() const {
    return *axes()[static_cast<std::size_t>(GetParam())];
  }
};

INSTANTIATE_TEST_SUITE_P(Each, DeviceCommands, testing::Range(0, static_cast<int>(axes().size())),
                         [](const auto& instance) {
                           const auto place = static_cast<std::size_t>(instance.param);
                           return std::string(axes()[place]->type->name);
                         });

TEST_P(DeviceCommands, RandomSequencesBreakNoLawAndEndInAStart) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::uint8_t> data(3000);
    for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random());
    data[0] = static_cast<std::uint8_t>(GetParam());
    ASSERT_EQ(play_device_commands(data), "") << "seed " << seed;
  }
}

TEST_P(DeviceCommands, AMillionSamplesAtAGigahertzAreCountedToTheBit) {
  DevicePlayer player(entry(), 1, 2);
  player.set_up();
  for (const char* name : {"INIT", "LOOPON", "CNTUNLOCK"}) player.command(name);
  player.device->sample();
  constexpr std::int64_t bits = 1'000'000;  // a sample
  std::int64_t count = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    for (auto& [address, counter] : player.cards.counters) counter.count += bits;
    count += bits;
    player.device->sample();
    if (i % 1000 == 0) static_cast<void>(player.device->take_diagnostics());
  }
  EXPECT_EQ(player.get("posit"), static_cast<std::int32_t>(count));  // the variable's 32 bits of it
}

}  // namespace
}  // namespace drycut::fuzz
