#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "devices/plcopen/axis_parameters.hpp"
#include "devices/plcopen/coupling.hpp"
#include "devices/plcopen/requests.hpp"

namespace drycut::devices::plcopen {

/// What the drive tells the axis; the owner of the kernel writes it before each cycle.
struct DriveInputs {
  std::int64_t counts = 0;        ///< of the encoder, x4 edges, never wraps
  bool ready = true;              ///< false: the drive no longer follows
  bool emergency_stop = false;    ///< seen over the drive interface; the drive still follows setpoints
  std::int64_t probe_counts = 0;  ///< of the encoder at the last rising edge of the probe
  std::uint32_t probe_edges = 0;  ///< rising edges of the probe so far

  void visit(StateArchive& archive);
};
/// What the axis tells the drive, valid after each cycle.
struct DriveOutputs {
  std::int16_t reference = 0;  ///< DAC word, -32767..32767 = -10..+10 V
  bool enable = false;

  void visit(StateArchive& archive);
};
/// The operator's hand on the axis.
struct AxisControl {
  bool feed_enable = true;
  bool feed_hold = false;
  double override_percent = 100;  ///< 0..100

  void visit(StateArchive& archive);
};

/// How a slave hangs on its master.
struct CouplingLink {
  AxisRef master;
  bool actual_values = false;  ///< follows the master's encoder, not its setpoints
  std::uint16_t table = 0;     ///< 0 for a gear
  std::uint64_t revision = 0;  ///< of the table when the curve was made
  bool locks_table = false;
  bool own_copy = false;  ///< changes of the table do not reach the coupling
  Endless endless = Endless::no;
  Interpolation interpolation = Interpolation::linear;

  void visit(StateArchive& archive);
};

/// How far a command is. `failed` goes with the error that ended it.
enum class Progress : std::uint8_t { none, waiting, active, done, aborted, failed };
struct CommandState {
  Progress progress = Progress::none;
  ErrorId error = ErrorId::none;

  void visit(StateArchive& archive);
};

/// A command that waits for its turn.
struct WaitingCommand {
  std::uint64_t ticket = 0;
  BufferMode mode = BufferMode::buffered;
  Request request = {};

  void visit(StateArchive& archive);
};
/// Further ones are refused (44000). The kernel's own number is not published.
inline constexpr std::size_t most_waiting = 8;

/// What happened at an axis and is no error: an event's name and its text.
struct AxisRemark {
  std::string event;
  std::string text;

  void visit(StateArchive& archive);
};

/// A superimposed movement.
struct Overlay {
  JerkProfile profile = {};
  double time = 0;
  std::uint64_t ticket = 0;

  void visit(StateArchive& archive);
};

/// One axis: setpoints by the state diagram, actual values from counts, and the position controller that
/// makes the drive's reference. Lengths are increments of 0.1 um or 0.0001 deg throughout.
class Axis {
 public:
  Axis(std::string name, const AxisParameters& parameters);

  DriveInputs drive;
  AxisControl control;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const AxisParameters& parameters() const { return parameters_; }
  /// See plcopen::set_parameter; in force from the next cycle. `kind` and `modulo` only in Disabled.
  bool set_parameter(const AxisParameter& parameter, double value);

  [[nodiscard]] AxisState state() const { return state_; }
  [[nodiscard]] ErrorId error() const { return error_; }
  [[nodiscard]] bool powered() const { return powered_; }
  [[nodiscard]] bool homed() const { return homed_; }
  [[nodiscard]] double modulo() const { return parameters_.modulo; }
  /// Commanded motion at the end of the last cycle.
  [[nodiscard]] const AxisMotion& set() const { return set_; }
  /// Change of the commanded acceleration in the last cycle, over its time [inc/s3].
  [[nodiscard]] double set_jerk() const {
    return cycle_time_ > 0 ? (set_.acceleration - acceleration_before_) / cycle_time_ : 0;
  }
  [[nodiscard]] const Position& actual() const { return actual_; }
  [[nodiscard]] double actual_velocity() const { return actual_velocity_; }
  [[nodiscard]] double following_error() const { return difference(set_.position, actual_, modulo()); }
  [[nodiscard]] const DriveOutputs& outputs() const { return outputs_; }
  /// As a master of setpoints, or of actual values with the slave's dead time [s].
  [[nodiscard]] AxisMotion as_master(bool actual_values, double delay) const;

  /// Ticket of the command in force, and whether it has done what it was asked.
  [[nodiscard]] std::uint64_t ticket() const { return ticket_; }
  [[nodiscard]] bool done() const { return done_; }
  /// How far the command with this ticket is; of those that have ended only the last few are known.
  [[nodiscard]] CommandState state_of(std::uint64_t ticket) const;
  /// Where the movement under way leads to; where the axis is commanded to be if it leads nowhere.
  [[nodiscard]] Position target() const;
  /// The speed of the command in force was cut to dynamik.vb_max, or the slave cannot follow its law.
  [[nodiscard]] bool warning() const { return speed_cut_ || (coupling_ && coupling_->clamped()); }
  /// The slave is where its law wants it.
  [[nodiscard]] bool in_place() const { return done_ && coupling_ && coupling_->in_place(); }
  /// Cam ends passed while engaged, since the command in force began.
  [[nodiscard]] std::int64_t profile_ends() const { return profile_ends_; }

  Order power(bool on);
  /// The present actual position becomes `position`; takes one cycle.
  Order home(double position);
  /// The present actual position becomes `position`, or with `relative` more by it; nothing moves. The caller
  /// has seen to it that no slave follows.
  ErrorId set_position(double position, bool relative);
  /// MC_SetOverride: share of the speeds of movements, 0..1, together with the operator's.
  ErrorId set_override(double factor);
  /// What is wrong with the request's pins.
  [[nodiscard]] ErrorId check(const MoveRequest& request, JerkLimits& limits) const;
  /// Each of MC_MoveAbsolute, Relative, Additive and Velocity. `ticket`: of a command whose turn has come;
  /// 0: a new one, which ends whatever is under way.
  Order move(const MoveRequest& request, std::uint64_t ticket = 0);
  /// MC_MoveSuperImposed: `distance` more than what is under way. In Standstill a movement of its own.
  Order superimpose(double distance, const Dynamics& dynamics);
  Order halt(const Dynamics& dynamics) { return slow_down(Command::halt, dynamics); }
  Order stop(const Dynamics& dynamics) { return slow_down(Command::stop, dynamics); }
  /// MC_Stop's Execute has become FALSE: Stopping ends as soon as the axis stands.
  void release_stop(std::uint64_t ticket);
  Order reset();
  /// Couples; the caller has checked master and cam.
  Order couple(Coupling coupling, const CouplingLink& link, Command command, std::uint64_t ticket = 0);
  /// The slave goes on at its present speed.
  Order uncouple(Command command);

  // Commands that wait for their turn. The kernel starts them: it knows masters and tables.

  /// A command that waits would have its turn now.
  [[nodiscard]] bool takes_next() const;
  [[nodiscard]] const std::deque<WaitingCommand>& waiting() const { return waiting_; }
  /// 44000 if too many wait.
  Order wait(const Request& request, BufferMode mode);
  WaitingCommand take_next();
  /// The command could not be started: it has failed, those behind it are aborted, the axis comes to rest.
  void drop(std::uint64_t ticket, ErrorId error);
  /// The first waiting command shall find the axis at the speed of its mode where the present movement ends.
  void blend();
  /// The rest of a cycle in which one movement has passed over into the next.
  void run_on();
  /// Where a command begins: of a new one (ticket 0) with what is superimposed.
  [[nodiscard]] AxisMotion start_of(std::uint64_t ticket) const;

  /// Touch probe: a new order, or an abortion, takes it from the order before.
  std::uint64_t take_probe() { return ++probe_ticket_; }
  [[nodiscard]] std::uint64_t probe_ticket() const { return probe_ticket_; }
  /// Where the axis was at the last rising edge of its probe.
  [[nodiscard]] Position probe_position() const { return position_of(drive.probe_counts); }

  [[nodiscard]] const Coupling* coupling() const { return coupling_ ? &*coupling_ : nullptr; }
  Coupling* coupling() { return coupling_ ? &*coupling_ : nullptr; }
  [[nodiscard]] const CouplingLink& link() const { return link_; }
  CouplingLink& link() { return link_; }
  /// Acceleration and jerk of MC_GearIn; a value of 0 takes the axis' own.
  void set_gear_dynamics(const Dynamics& dynamics) { gear_dynamics_ = dynamics; }

  /// Limits of a command's dynamics in increments; the error names the pin that is out of range.
  ErrorId limits_of(const Dynamics& dynamics, JerkLimits& limits) const;

  // The parts of a cycle, in the kernel's order.
  void latch(double dt);
  /// Setpoints of an axis that is not coupled.
  void move(double dt);
  /// Setpoints of a slave.
  void follow(const AxisMotion& master, double dt);
  void regulate();

  void fault(ErrorId error);
  [[nodiscard]] bool has_remarks() const { return !remarks_.empty(); }
  std::vector<AxisRemark> take_remarks() { return std::exchange(remarks_, {}); }

  void visit(StateArchive& archive);

 private:
  /// How a command ended that is no longer in force.
  struct Ended {
    std::uint64_t ticket = 0;
    CommandState state = {};

    void visit(StateArchive& archive);
  };

  [[nodiscard]] Position position_of(std::int64_t counts) const;
  [[nodiscard]] CouplingLimits coupling_limits() const;
  [[nodiscard]] bool limited() const;
  [[nodiscard]] bool passes_limit(const AxisMotion& next, bool with_braking) const;
  [[nodiscard]] MotionState plan_from(const AxisMotion& from) const;
  [[nodiscard]] double way_of(const MoveRequest& request, const AxisMotion& from,
                              const JerkLimits& limits) const;
  [[nodiscard]] double changeover_speed(const WaitingCommand& next) const;
  void remember(std::uint64_t ticket, CommandState state);
  void abort_waiting(CommandState state);
  void end_overlay(CommandState state);
  void advance_overlay(double step);
  [[nodiscard]] AxisMotion with_overlay(const AxisMotion& base) const;
  /// `way` more, without an end of what is under way.
  void shift(double way);
  Order slow_down(Command command, const Dynamics& dynamics);
  Order begin(AxisState to, std::uint64_t ticket = 0);
  void run(const JerkProfile& profile);
  void run_profile(double dt);
  void advance(double step);
  void finish_profile();
  void brake(double dt);
  void move_zero(double shift);
  void stand_on_actual();

  const std::string name_;
  AxisParameters parameters_;
  std::uint64_t last_ticket_ = 0;
  std::uint64_t ticket_ = 0;
  std::uint64_t probe_ticket_ = 0;
  std::deque<WaitingCommand> waiting_;
  std::deque<Ended> ended_;
  std::vector<AxisRemark> remarks_;

  AxisMotion base_;                 ///< commanded motion without what is superimposed
  AxisMotion set_;                  ///< commanded motion
  double acceleration_before_ = 0;  ///< set_.acceleration at the end of the cycle before
  double cycle_time_ = 0;           ///< [s], 0 before the first cycle
  Position actual_;
  double home_offset_ = 0;
  double home_to_ = 0;
  double actual_velocity_ = 0;
  std::deque<double> velocities_;  ///< of the last cycles, for the average filter

  std::optional<JerkProfile> profile_;
  Position profile_origin_;
  double profile_time_ = 0;
  double override_ = 1;             ///< in force
  double program_override_ = 1;     ///< of MC_SetOverride
  double leftover_ = 0;             ///< of the profile's time after its end, when the next one takes over
  JerkLimits limits_;               ///< of the movement under way
  std::optional<Position> target_;  ///< of a discrete movement, without what is superimposed

  std::optional<Overlay> overlay_;
  double overlay_sum_ = 0;  ///< superimposed on a coupling so far

  std::optional<Coupling> coupling_;
  CouplingLink link_;
  std::int64_t profile_ends_ = 0;
  Dynamics gear_dynamics_;

  ErrorId error_ = ErrorId::none;
  DriveOutputs outputs_;
  AxisState state_ = AxisState::disabled;
  bool powered_ = false;
  bool homed_ = false;
  bool resetting_ = false;
  bool done_ = false;
  bool latched_ = false;
  bool stop_held_ = false;
  bool speed_cut_ = false;      ///< Velocity was above dynamik.vb_max
  bool profile_ended_ = false;  ///< the cam came to its end in the last cycle
};

enum class AxisQuantity : std::uint8_t { number, position, velocity, acceleration, jerk, volts, percent };
/// "mm/s", "deg/s", ... "" for a number.
std::string_view unit_of(AxisQuantity quantity, Measure measure);

/// A value of an axis that people record, check and set, in mm or deg and seconds.
struct AxisValue {
  std::string_view name;
  AxisQuantity quantity = AxisQuantity::number;
  std::string_view meaning;
  double (*read)(const Axis& axis) = nullptr;
  void (*write)(Axis& axis, double value) = nullptr;  ///< nullptr: can only be read
  double min = 0;                                     ///< of one that can be written
  double max = 0;
  bool in_turn = false;  ///< of a modulo axis: begins again with each turn
};
std::span<const AxisValue> axis_value_table();

/// A parameter of an axis by PLCopen's number (part 1, table of parameters), as MC_ReadParameter gives it.
/// ISG's own blocks take the machine data's names as texts instead.
struct NumberedParameter {
  int number = 0;
  std::string_view name;
  std::string_view unit;
  double (*read)(const Axis& axis) = nullptr;
  double AxisParameters::*written = nullptr;  ///< nullptr: MC_WriteParameter refuses it
  std::string_view meaning;
};
/// Those with a number as value; the BOOL ones (4, 5, 6) are none of them.
std::span<const NumberedParameter> numbered_parameters();
/// nullptr if there is none.
const NumberedParameter* find_numbered_parameter(int number);
/// MC_WriteParameter: in Standstill and Disabled only, as ISG demands. 65020 if it cannot be written, 65021
/// if the value is out of its range or the software limits would cross.
ErrorId write_numbered_parameter(Axis& axis, int number, double value);

}  // namespace drycut::devices::plcopen
