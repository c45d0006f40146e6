#include "plants/guest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/state_archive.hpp"
#include "plants/world.hpp"

namespace drycut::plants {
namespace {

using Role = GuestVariable::Role;
using Type = GuestVariable::Type;

// A model without a process: it sums its input, which is in millivolts, and turns an encoder by 7.5 counts a
// step, whose index comes at a quarter of every second step.
class Summing : public GuestModel {
 public:
  explicit Summing(double gain) : gain_(gain) {}
  void begin_step(double at, double size, std::span<const double> inputs) override {
    at_ = at;
    size_ = size;
    sum_ += gain_ * inputs[0];
    on_ = inputs[1];
    if (sum_ > 1e6) throw std::runtime_error("it is too much");
  }
  void end_step(std::span<double> outputs) override {
    ++steps_;
    outputs[0] = sum_;
    outputs[1] = 7.5 * steps_;
    outputs[2] = on_;
    outputs[3] = steps_ / 2;
    outputs[4] = steps_ % 2 == 0 ? at_ + size_ / 4 : outputs[4];
    outputs[5] = steps_ % 2 == 0 ? 7.0 * (steps_ - 1) + 2 : outputs[5];
  }
  std::vector<std::byte> save() override {
    std::vector<std::byte> bytes;
    StateArchive::save(bytes, [&](StateArchive& archive) { STATE(archive, sum_, steps_, on_); });
    return bytes;
  }
  void restore(std::span<const std::byte> state) override {
    auto archive = StateArchive::restoring(state.data(), state.size());
    STATE(archive, sum_, steps_, on_);
  }

 private:
  double gain_;
  double at_ = 0;
  double size_ = 0;
  double sum_ = 0;
  double on_ = 0;
  int steps_ = 0;
};

class SummingType : public GuestType {
 public:
  explicit SummingType(bool keeps_state) : keeps_state_(keeps_state) {
    GuestVariable volts{"in", "", Role::input, Type::real, "mV"};
    volts.is_voltage = true;
    volts.si_factor = 1e-3;
    GuestVariable gain{"gain", "of the sum", Role::parameter};
    gain.start = 1;
    variables_ = {gain,
                  volts,
                  {"enable", "", Role::input, Type::flag},
                  {"sum", "", Role::output, Type::real, "mm"},
                  {"axis", "", Role::output, Type::real},
                  {"axis.index", "", Role::output, Type::flag},
                  {"axis.index.rises", "", Role::output, Type::whole},
                  {"axis.index.rise_time", "", Role::output, Type::real, "s"},
                  {"axis.index.latch", "", Role::output, Type::whole}};
  }
  [[nodiscard]] const std::string& origin() const override { return origin_; }
  [[nodiscard]] const std::vector<GuestVariable>& variables() const override { return variables_; }
  [[nodiscard]] bool keeps_state() const override { return keeps_state_; }
  [[nodiscard]] double fixed_step() const override { return 2e-3; }
  std::unique_ptr<GuestModel> start(const Start& start, std::span<double> outputs) const override {
    std::ranges::fill(outputs, 0);
    double gain = 1;
    for (const auto& [place, value] : start.parameters) gain = std::get<double>(value);
    if (gain < 0) throw std::runtime_error("it sums no negative gain");
    return std::make_unique<Summing>(gain);
  }

 private:
  bool keeps_state_;
  std::string origin_ = "a model of the test";
  std::vector<GuestVariable> variables_;
};

struct Line {
  explicit Line(double gain = 1, bool keeps_state = true) {
    GuestDefinition definition;
    definition.open(std::make_shared<SummingType>(keeps_state), "summing");
    for (auto& row : definition.parameters()) {
      if (row.name == "every") *std::get<double*>(row.value) = 2e-3;
      if (row.name == "parameters.gain") *std::get<double*>(row.value) = gain;
    }
    EXPECT_TRUE(definition.objections(h).empty());
    guest = definition.build(world, [](std::string_view) { return nullptr; });
    for (auto& port : guest->ports()) ports.push_back(port);
  }
  template <class Port>
  Port& port(const std::string& name) {
    for (auto& one : ports)
      if (one.name == name) return *std::get<Port*>(one.plug);
    throw std::invalid_argument(name);
  }
  double read(const std::string& name) {
    for (auto& channel : guest->channels())
      if (channel.name == name) return channel.read();
    throw std::invalid_argument(name);
  }
  void step() {
    guest->drive(h);
    world.step(h);
    guest->sense(h);
  }
  static constexpr double h = 1e-3;
  World world{1};
  std::unique_ptr<Plant> guest;
  std::vector<Port> ports;
};

TEST(Guest, InputsHoldOverAStepAndOutputsAreSeenFromItsEndOn) {
  Line line(2);
  line.port<ReferencePort>("in").volts = 0.005;  // 5 mV
  line.step();
  EXPECT_EQ(line.read("sum"), 0);
  line.port<ReferencePort>("in").volts = 0.007;  // too late for this step of 2 ms
  line.step();
  EXPECT_DOUBLE_EQ(line.read("sum"), 10);
  EXPECT_DOUBLE_EQ(line.read("in"), 7);
  for (int n = 0; n < 2; ++n) line.step();
  EXPECT_DOUBLE_EQ(line.read("sum"), 24);
  EXPECT_EQ(line.port<EncoderPort>("axis").count, 15);
}

TEST(Guest, EdgesStandWhereTheModelHasThemAndTheEncoderIsLatchedThere) {
  Line line;
  auto& index = line.port<SignalPort>("axis.index");
  for (int n = 0; n < 3; ++n) {
    line.step();
    EXPECT_TRUE(index.edges.empty());
  }
  line.step();  // the second step of the model ends here: from 2 ms to 4 ms, its index at 2.5 ms
  ASSERT_EQ(index.edges.size(), 2U);
  EXPECT_TRUE(index.edges[0].rising);
  EXPECT_FALSE(index.edges[1].rising) << "it is off at the end";
  EXPECT_EQ(index.edges[0].fraction, 0) << "before the last millisecond, which is all that is seen";
  EXPECT_EQ(line.port<EncoderPort>("axis").count_at(0), 9);
  EXPECT_EQ(line.port<EncoderPort>("axis").count_at(1), 15);
}

TEST(Guest, ItsStateIsKeptAtAnyMomentOrRefused) {
  Line line;
  line.port<ReferencePort>("in").volts = 0.003;
  for (int n = 0; n < 5; ++n) line.step();
  StateArchive::Bytes state;
  StateArchive::save(state, *line.guest);
  Line other;
  auto archive = StateArchive::restoring(state.data(), state.size());
  other.guest->visit(archive);
  EXPECT_EQ(archive.left(), 0U);
  for (int n = 0; n < 5; ++n) {
    line.step();
    other.step();
    EXPECT_EQ(other.read("sum"), line.read("sum"));
    EXPECT_EQ(other.read("axis.index.rises"), line.read("axis.index.rises"));
  }
  EXPECT_GT(line.read("sum"), 0);
  Line none(1, false);
  StateArchive::Bytes nothing;
  EXPECT_THROW(StateArchive::save(nothing, *none.guest), std::runtime_error);
}

TEST(Guest, WhatFailsIsToldToTheWorld) {
  Line line;
  line.port<ReferencePort>("in").volts = 400;
  for (int n = 0; n < 6; ++n) line.step();
  EXPECT_EQ(line.world.failure(), "summing at 0.004 s: it is too much");
  EXPECT_DOUBLE_EQ(line.read("sum"), 800000) << "what it had before stays";
  const Line never(-1);
  EXPECT_EQ(never.world.failure(), "it sums no negative gain");
}

TEST(Guest, StepsThatTheModelCannotTakeAreRefused) {
  GuestDefinition definition;
  definition.open(std::make_shared<SummingType>(true), "summing");
  const auto every = [&](double seconds) {
    for (auto& row : definition.parameters())
      if (row.name == "every") *std::get<double*>(row.value) = seconds;
    return definition.objections(1e-3).size();
  };
  EXPECT_EQ(every(0), 1U) << "1 ms, of a model that steps by 2 ms";
  EXPECT_EQ(every(2e-3), 0U);
  EXPECT_EQ(every(6e-3), 0U);
  EXPECT_EQ(every(2.5e-3), 1U);
}

}  // namespace
}  // namespace drycut::plants
