#pragma once
#include <cstdint>
#include <string>

namespace drycut {
class StateArchive;
}

namespace drycut::devices::lx3vp {

/// S1 of DECAM: what moves the master of the cam (003 2.2).
struct MasterSource {
  enum class Kind : std::uint8_t {
    counter,  ///< C: pulses of a high-speed counter's terminals, else the register's changes
    word,     ///< D: changes of the 32-bit value there
    time      ///< K: one count every `number` x 100 us
  };
  Kind kind = Kind::counter;
  std::int32_t number = 0;
  bool operator==(const MasterSource&) const = default;
  void visit(StateArchive& archive);
};

/// S3 of DECAM: the start signal from outside.
struct StartSignal {
  bool is_input = true;  ///< X, else M
  int number = 0;        ///< plain: X10 is 8
  bool operator==(const StartSignal&) const = default;
  void visit(StateArchive& archive);
};

/// Operands of DECAM as the program gives them; what they must be is checked when they are executed (6781).
struct DecamOperands {
  MasterSource master;
  int block = 0;  ///< S2, first D of the parameter block
  StartSignal start;
  int output = 0;     ///< D1, plain number of the pulse output Y
  int direction = 0;  ///< D2, plain number of the direction output Y; on = forwards
  bool operator==(const DecamOperands&) const = default;
  void visit(StateArchive& archive);
};

/// S3 of ZRN: the switch near the zero point.
struct DogSignal {
  char letter = 'X';  ///< X, Y, M or S
  int number = 0;     ///< plain: X10 is 8
  void visit(StateArchive& archive);
};

/// What DPLSV, DDRVI, DDRVA, PLSY, PLSR, PWM and ZRN ask of a pulse output. All but DPLSV and PWM begin on
/// the rising edge of power, set M8029 when they are done, and stop as power goes off.
struct PulseOrder {
  enum class Kind : std::uint8_t {
    speed,  ///< DPLSV: at `frequency` at once, without ramp, backwards if negative, as long as it has power
    distance,  ///< DDRVI: `pulses` at `frequency` with the ramps of D8145..D8148
    position,  ///< DDRVA: likewise to position `pulses`
    train,     ///< PLSY: `pulses` at once and without ramp, 0 = without end, counting forwards; the frequency
               ///< may change on the way
    ramped,    ///< PLSR: a train with ramps of `ramp_ms`
    pwm,       ///< PWM: no pulses, the output's level: on for `width_ms` of every `period_ms`
    zero       ///< ZRN: backwards, from the dog on at `creep`, to where the dog ends; the position is 0 then
  };
  Kind kind = Kind::speed;
  static constexpr int no_direction = -1;  ///< the direction is the program's own affair
  int output = 0;                          ///< plain number of Y
  int direction = no_direction;            ///< plain number of the Y that is on forwards
  std::int32_t frequency = 0;              ///< [Hz]
  std::int32_t pulses = 0;
  std::int32_t creep = 0;  ///< [Hz]
  DogSignal dog = {};
  std::int32_t ramp_ms = 0;
  std::int32_t width_ms = 0;
  std::int32_t period_ms = 0;
  void visit(StateArchive& archive);
};

/// What DHSCS, DHSCR and DHSZ ask of a high-speed counter, pulse by pulse.
struct CounterCompare {
  enum class Kind : std::uint8_t {
    set,    ///< DHSCS: the device goes on as the count comes to `low`, from either side
    reset,  ///< DHSCR: off; the counter itself goes on from 0
    zone    ///< DHSZ: three devices: below `low`, within, above `high`
  };
  Kind kind = Kind::set;
  int counter = 0;
  std::int32_t low = 0;
  std::int32_t high = 0;
  char letter = 'Y';  ///< Y, M or S; of DHSCR C; of DHSCS I, an interrupt
  int number = 0;     ///< plain: Y10 is 8
  void visit(StateArchive& archive);
};

/// What SPD asks of an input: how many pulses it gets in each `period_ms`.
struct SpeedMeasure {
  int input = 0;   ///< X0..X5
  int result = 0;  ///< first of three D
  std::int32_t period_ms = 0;
  void visit(StateArchive& archive);
};

/// What instructions do beyond the registers: the controller gives it to the scan of its program. Every call
/// comes once a scan for each instruction that the scan passes; `step` tells the instruction's place in the
/// program and is its identity from scan to scan.
class Instructions {
 public:
  Instructions() = default;
  virtual ~Instructions() = default;
  Instructions(const Instructions&) = delete;
  Instructions& operator=(const Instructions&) = delete;

  /// DECAM S1 S2 S3 D1 D2: `powered` is the power flow into it. On enables the cam, off stops it at once.
  virtual void decam(int step, const DecamOperands& operands, bool powered) = 0;

  /// DPLSV, DDRVI, DDRVA, PLSY or ZRN: `powered` is the power flow into it.
  virtual void pulses(int step, const PulseOrder& order, bool powered) = 0;

  /// OUT of a high-speed counter: counts the pulses of its terminals while powered; the contact is on from
  /// `preset` on. Register and contact are the controller's work then; RST C sets both back in the registers.
  virtual void high_speed_counter(int number, std::int32_t preset, bool powered) = 0;

  /// DHSCS, DHSCR, DHSZ: compares from pulse to pulse while powered.
  virtual void compare_counter(int step, const CounterCompare& compare, bool powered) = 0;

  /// SPD: measures while powered, as it was asked when power came.
  virtual void measure_speed(int step, const SpeedMeasure& measure, bool powered) = 0;

  /// REF: takes the levels of inputs, or gives those of outputs, at once. `letter` is X or Y.
  virtual void refresh(char letter, int first, int count) = 0;

  /// An error of an instruction while it runs (M8067, D8067, D8069 = step); the scan goes on behind it.
  /// `text` says where and what: "saw.il:12: 6706: ...".
  virtual void error(int step, int code, const std::string& text) = 0;

  /// The scan works longer than the PLC lets it (6105): it is broken off at `step`, and the PLC stops.
  virtual void watchdog(int step, const std::string& text) = 0;

  /// The result of an ECAMTBX: rows, or below 0 the error, then `text` says where and what:
  /// "saw.il:29: ECAMTBX -3: ...". Comes in every scan that executes it.
  virtual void cam_table(int step, std::int32_t result, const std::string& text) = 0;
};

/// What an output does in a tick of 100 us.
struct PulseTick {
  int pulses = 0;        ///< to give, of one direction
  bool forwards = true;  ///< level of the direction output
  bool late = false;     ///< the frequency limit held pulses back
};

/// A pulse output with its direction, by ticks. It never loses a pulse and never gives more than the
/// frequency allows; what it owes comes later. The direction changes a tick before the first pulse that way.
class PulseOutput {
 public:
  /// Pulses given since power-up, less those backwards.
  [[nodiscard]] std::int64_t position() const { return position_; }
  [[nodiscard]] bool forwards() const { return forwards_; }
  /// Sets the direction while nothing is owed, so that the first pulse that way need not wait.
  void face(bool forwards) { forwards_ = forwards; }

  /// One tick towards `target`, at most at `limit` [Hz], 0..200000.
  PulseTick follow(std::int64_t target, std::int32_t limit);
  /// One tick at `frequency` [Hz], -200000..200000, negative backwards; not more than `most` pulses.
  PulseTick run(std::int32_t frequency, std::int64_t most);
  /// Nothing is owed any more: what a fraction of a pulse has gathered is dropped.
  void halt() { credit_ = 0; }
  void visit(StateArchive& archive);

 private:
  PulseTick give(std::int64_t pulses, bool forwards);

  std::int64_t position_ = 0;
  std::int64_t credit_ = 0;  ///< pulses that the frequency has allowed and nobody used [1/10000 pulse]
  bool forwards_ = false;
};

inline constexpr std::int64_t tick_ns = 100'000;
inline constexpr int ticks_per_second = 10'000;

}  // namespace drycut::devices::lx3vp
