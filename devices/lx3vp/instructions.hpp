#pragma once
#include <cstdint>
#include <string>

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
};

/// S3 of DECAM: the start signal from outside.
struct StartSignal {
  bool is_input = true;  ///< X, else M
  int number = 0;        ///< plain: X10 is 8
  bool operator==(const StartSignal&) const = default;
};

/// S3 of ZRN: the switch near the zero point.
struct DogSignal {
  enum class Kind : std::uint8_t { x, y, m, s };
  Kind kind = Kind::x;
  int number = 0;  ///< plain: X10 is 8
};

/// Operands of DECAM as the program gives them; what they must be is checked when they are executed (6781).
struct DecamOperands {
  MasterSource master;
  int block = 0;  ///< S2, first D of the parameter block
  StartSignal start;
  int output = 0;     ///< D1, plain number of the pulse output Y
  int direction = 0;  ///< D2, plain number of the direction output Y; on = forwards
  bool operator==(const DecamOperands&) const = default;
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

  /// DPLSV S D1 D2: pulses at `frequency` [Hz] at once, without ramp, backwards if negative, as long as it is
  /// powered; `direction` is on forwards. Both outputs as plain numbers of Y.
  virtual void plsv(int step, std::int32_t frequency, int output, int direction, bool powered) = 0;

  /// DDRVI and DDRVA S1 S2 D1 D2: on the rising edge of power a move by (or to) `pulses` at `frequency` [Hz]
  /// with the ramps of D8145..D8148; off stops it. Sets M8029 when it has arrived.
  virtual void drive(int step, bool absolute, std::int32_t pulses, std::int32_t frequency, int output,
                     int direction, bool powered) = 0;

  /// PLSY S1 S2 D: on the rising edge of power `pulses` at `frequency` [Hz], at once and without ramp; 0
  /// pulses are a train without end. The frequency may change on the way; off stops it. Counts forwards and
  /// leaves the direction to the program. Sets M8029 when all are given.
  virtual void pulse_train(int step, std::int32_t frequency, std::int32_t pulses, int output,
                           bool powered) = 0;

  /// ZRN S1 S2 S3 D: on the rising edge of power backwards at `speed` [Hz], from the dog on at `creep` [Hz],
  /// to where the dog ends; the position is 0 then and M8029 set. Off stops it. Leaves the direction to the
  /// program.
  virtual void zero_return(int step, std::int32_t speed, std::int32_t creep, DogSignal dog, int output,
                           bool powered) = 0;

  /// OUT C235..C255 K: counts the pulses of its terminals while powered; the contact is on from `preset` on.
  /// Register and contact are the controller's work then; RST C sets both back in the registers.
  virtual void high_speed_counter(int number, std::int32_t preset, bool powered) = 0;

  /// An error of an instruction while it runs (M8067, D8067, D8069 = step); the scan goes on behind it.
  /// `text` says where and what: "saw.il:12: 6706: ...".
  virtual void error(int step, int code, const std::string& text) = 0;

  /// The scan works longer than the PLC lets it (6105): it is broken off at `step`, and the PLC stops.
  virtual void watchdog(int step, const std::string& text) = 0;

  /// The result of an ECAMTBX: rows, or below 0 the error, then `text` says where and what:
  /// "saw.il:29: ECAMTBX -3: ...". Comes in every scan that executes it.
  virtual void cam_table(int step, std::int32_t result, const std::string& text) = 0;
};

}  // namespace drycut::devices::lx3vp
