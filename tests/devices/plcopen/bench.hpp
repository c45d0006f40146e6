#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "devices/plcopen/function_blocks.hpp"
#include "tests/devices/plcopen/covers.hpp"

namespace drycut::devices::plcopen {

inline constexpr double turn = 3'600'000;
/// Start mode of a slave that turns on and on.
inline constexpr std::uint32_t turning = hli_ci_f_periodic | hli_ci_endless_positive;
inline constexpr double cycle_s = 0.002;

/// As the blocks' ErrorID pins have it.
inline unsigned id(ErrorId error) { return static_cast<unsigned>(error); }

inline AxisParameters axis_of(AxisKind kind) {
  AxisParameters parameters;
  parameters.kind = kind;
  return parameters;
}

/// The pin of this name; nullptr if there is none.
template <typename T>
T* pin_of(const BlockType& type, FunctionBlock& block, const char* name) {
  const int number = find_pin(type, name);
  return number < 0 ? nullptr : std::get<T*>(type.pin(block, static_cast<std::size_t>(number)));
}

/// Gives a block a rising edge of Execute.
template <typename Block>
void execute(Block& block, MotionKernel& kernel) {
  block.Execute = false;
  block.call(kernel);
  block.Execute = true;
  block.call(kernel);
}

/// A virtual master and a virtual slave, both turning, with the ramp-in set to usable values.
struct Bench {
  MotionKernel kernel;
  AxisRef master;
  AxisRef slave;
  McPower power_master;
  McPower power_slave;
  McMoveVelocity run;
  McCamIn cam;

  static AxisParameters virtual_axis() {
    AxisParameters parameters;
    parameters.kind = AxisKind::virtual_axis;
    parameters.homed_at_start = true;
    parameters.is_master = true;
    parameters.j_vel_sync = 100'000;
    parameters.v_phasing = 200'000;
    parameters.a_phasing = parameters.d_phasing = 2'000;
    parameters.j_phasing = 50'000;
    return parameters;
  }

  /// Without turns; between its software limits, if they differ.
  static AxisParameters linear_axis(double swe_neg = 0, double swe_pos = 0) {
    AxisParameters parameters = virtual_axis();
    parameters.modulo = 0;
    parameters.swe_neg = swe_neg;
    parameters.swe_pos = swe_pos;
    return parameters;
  }

  explicit Bench(const AxisParameters& slave_parameters = virtual_axis()) {
    master = kernel.add_axis("Master", virtual_axis());
    slave = kernel.add_axis("Slave", slave_parameters);
    power_master.Axis = run.Axis = cam.Master = master;
    power_slave.Axis = cam.Slave = slave;
    power_master.Enable = power_slave.Enable = true;
    power_master.call(kernel);
    power_slave.call(kernel);
    run.Velocity = 360'000;  // one turn a second
  }

  /// A block for the slave, and of a coupling behind the master.
  template <typename Block>
  Block make(double velocity = 0) {
    Block block;
    if constexpr (requires { block.Axis; }) block.Axis = slave;
    if constexpr (requires { block.Slave; }) block.Slave = slave;
    if constexpr (requires { block.Master; }) block.Master = master;
    if constexpr (requires { block.Velocity; }) block.Velocity = velocity;
    return block;
  }
  /// Cycles of the kernel, after each of which the blocks are called.
  template <typename... Blocks>
  void cycles(int times, Blocks&... blocks) {
    for (int i = 0; i < times; ++i) {
      kernel.cycle();
      (blocks.call(kernel), ...);
    }
  }
  /// Cycles until the block is done or fails; their number.
  template <typename Block>
  int finish(Block& block, int most = 20'000) {
    int times = 0;
    for (; times < most && !block.Done && !block.Error; ++times) cycles(1, block);
    return times;
  }

  Axis& m() { return *kernel.axis(master); }
  Axis& s() { return *kernel.axis(slave); }
  /// Slave and master as unwrapped positions.
  double at(Axis& axis) {
    return static_cast<double>(axis.set().position.turns) * turn + axis.set().position.part;
  }

  /// A parameter of the slave, by its name.
  void set(const std::string& name, double value) {
    ASSERT_NE(find_axis_parameter(name), nullptr) << name;
    ASSERT_TRUE(s().set_parameter(*find_axis_parameter(name), value)) << name;
  }

  void table(std::vector<double> values, int type = 3, Interpolation interpolation = Interpolation::linear,
             std::uint16_t id = 1) {
    ASSERT_EQ(kernel.add_table({.file = "cam.tab",
                                .name = "cam",
                                .id = id,
                                .type = type,
                                .interpolation = interpolation,
                                .values = std::move(values)}),
              ErrorId::none);
    cam.CamTableID = id;
  }

  /// One PLC cycle with one cycle of the kernel.
  void step(int times = 1) {
    for (int i = 0; i < times; ++i) {
      run.call(kernel);
      cam.call(kernel);
      kernel.cycle();
    }
  }
  /// Steps until `condition`; the number of steps, or -1 after `most`.
  int until(const std::function<bool()>& condition, int most = 20'000) {
    for (int i = 0; i < most; ++i) {
      if (condition()) return i;
      step();
    }
    return -1;
  }
  void start_master() {
    run.Execute = true;
    ASSERT_GE(until([&] { return run.InVelocity; }), 0);
  }
  /// A new rising edge of MC_CamIn.
  void couple(std::uint32_t mode = hli_ci_f_periodic) {
    cam.StartMode = mode;
    cam.Execute = false;
    cam.call(kernel);
    cam.Execute = true;
    step();
  }
  /// The same, and until it is in place.
  void engage(std::uint32_t mode = hli_ci_f_periodic) {
    couple(mode);
    ASSERT_GE(until([&] { return cam.InSync; }), 0);
  }
  CouplingPhase phase() { return s().coupling()->phase(); }
};

/// A linear cam that turns the slave once for each turn of the master.
inline std::vector<double> one_to_one() { return {0, 900'000, 1'800'000, 2'700'000}; }

/// A bench with such a cam, its master under way.
struct Turning : Bench {
  Turning() {
    table(one_to_one());
    start_master();
  }
};

/// A rise to half a turn and back, at rest at both ends of the cam.
inline std::vector<double> swing() { return {0, 0, 600'000, 0, 1'200'000, 1'800'000, 1'800'000, 1'800'000}; }

/// Largest speed, acceleration, deceleration and jerk of what a block does.
struct Peaks {
  double v = 0, a = 0, d = 0, j = 0, last = 0;
  void take(const AxisMotion& motion) {
    v = std::max(v, std::abs(motion.velocity));
    a = std::max(a, motion.acceleration);
    d = std::max(d, -motion.acceleration);
    j = std::max(j, std::abs(motion.acceleration - last) / cycle_s);
    last = motion.acceleration;
  }
};

}  // namespace drycut::devices::plcopen
