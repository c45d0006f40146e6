#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "devices/cam/law.hpp"

namespace drycut {
class StateArchive;
}

namespace drycut::devices::lx3vp {

/// A cam cycle as ECAMTBX constructs it (003 6.3 and its appendix), before anything is rounded to pulses: the
/// ratio of the slave to the master over the master's position, as a row of transitions [pulses].
struct CamProfile : CamLaw {
  double sync_begin = 0;  ///< of the synchronous zone on the master; equal to `sync_end`: there is none
  double sync_end = 0;
  bool stops = false;  ///< midCAMend: the cam stops by itself at the end of the cycle

  [[nodiscard]] bool is_synchronous(double master) const { return master > sync_begin && master < sync_end; }
  /// Appends a piece; one without length is left out, one that goes on at the same constant ratio is joined.
  void add(double length, double r0, double r1, Transition shape);
  /// The same profile run in the opposite direction.
  void mirror();
};

// ECAMTBX makes the table of a cam from a list of parameters (003 6.3, appendix). The manual names the laws
// and shows results; how a table follows from its parameters is our derivation, by the manual's demos.

/// Type of the table, operand S1.
enum class EcamType : int { s_curve_0 = 0, s_curve_1 = 1, rotary_saw = 100, fly_saw = 101 };
inline bool is_s_curve(EcamType type) { return type == EcamType::s_curve_0 || type == EcamType::s_curve_1; }

/// Parameters of K100 and K101, by the manual's numbers.
struct SawParameters {
  std::int32_t master_length = 0;  ///< P1 [pulses]; of K101: of the forward and of the return stroke each
  std::int32_t slave_length = 0;   ///< P2 [pulses], negative backwards
  std::int32_t sync_length = 0;    ///< P3, of the slave in the synchronous zone [pulses], 0..|P2|
  float sync_ratio = 0;            ///< P4, slave to master in the synchronous zone, above 0
  float max_ratio = 0;             ///< P5, at least P4
  std::uint16_t acceleration = 0;  ///< P6 low word: 0 uniform, 1 uniform acceleration, 2 B type
  std::uint16_t curve = 0;         ///< P6 high word: 0, 1, 2, 3 or 5 (K100); bit 12 returns (slave backwards)
  std::uint16_t resolution = 0;    ///< P7, rows: 10..512, 0 = automatic
  bool operator==(const SawParameters&) const = default;
  void visit(StateArchive& archive);
};
/// The cam curves of P6.
enum SawCurve : std::uint16_t {
  left_cam = 0,
  mid_cam_all = 1,
  mid_cam_begin = 2,
  mid_cam_end = 3,
  right_cam = 5,
  return_square = 0x1000  ///< a bit: "H1000", the negative square
};

/// Parameters of K0 and K1.
struct SCurveParameters {
  std::int32_t length = 0;        ///< P1 [pulses], negative backwards, not 0
  std::int32_t top_speed = 0;     ///< P2 [Hz], 1..150000
  std::int16_t acceleration = 0;  ///< P4 [ms], 0..32767
  std::int16_t deceleration = 0;  ///< P5 [ms], 0..32767
  std::uint16_t resolution = 0;   ///< P6, rows: 51..512
  bool operator==(const SCurveParameters&) const = default;
  void visit(StateArchive& archive);
};

/// A row of a cam table, both positions in pulses (the master of K0 and K1: in counts of 100 us).
struct CamTableRow {
  std::int32_t master = 0;
  std::int32_t slave = 0;
  friend bool operator==(const CamTableRow&, const CamTableRow&) = default;
  void visit(StateArchive& archive);
};

/// What ECAMTBX reports in D1 below 0; the manual says only that it is an error.
enum class EcamError : int {
  none = 0,
  type = -1,        ///< S1, P6: no such table, law or curve
  length = -2,      ///< P1 or P2 is 0, negative or beyond the registers
  sync_zone = -3,   ///< longer than the cycle or than the slave; K101: the stroke does not fit
  ratio = -4,       ///< P5 is below P4 or below what the cycle needs
  resolution = -5,  ///< P7 (P6 of K0, K1) out of range, or more rows than the master has pulses for
  speed = -6,       ///< P2, P4 or P5 of K0, K1 out of range
  area = -7,        ///< the table does not fit the D registers
  number = -8       ///< P4 or P5 is no finite number above 0
};
/// In words, with the parameter to change: "the synchronous zone is longer than ...".
std::string_view error_text(EcamError error);
/// All errors, from -1 down.
std::span<const EcamError> ecam_errors();

/// A generated table, or the error.
struct EcamResult {
  EcamError error = EcamError::none;
  std::vector<CamTableRow> rows;  ///< from (0, 0) to the exact end; empty with an error
  CamProfile profile;             ///< the laws behind the rows, in full precision
  // What K0 and K1 report in P10 and P11.
  std::int32_t uniform_time = 0;   ///< at top speed [100 us]
  std::int32_t speed_reached = 0;  ///< [Hz]

  [[nodiscard]] bool ok() const { return error == EcamError::none; }
  /// D1: the number of rows, or the error.
  [[nodiscard]] std::int32_t code() const {
    return ok() ? static_cast<std::int32_t>(rows.size()) : static_cast<std::int32_t>(error);
  }
};

/// K100: the slave runs at P4 in the synchronous zone and makes up the rest of P2 in the rest of P1.
EcamResult make_rotary_saw(const SawParameters& parameters);
/// K101: from rest to P4, the synchronous zone, to rest after P2; then the same way back. Master 2 P1.
EcamResult make_fly_saw(const SawParameters& parameters);
/// K0 and K1: P2 and back to rest over P1 pulses, the time as master.
EcamResult make_s_curve(EcamType type, const SCurveParameters& parameters);
/// By its type, whatever it is.
EcamResult make_table(EcamType type, const SawParameters& saw, const SCurveParameters& s_curve);

/// Largest distance of the table, played as straight pieces, from the laws [pulses], looked for at 16 points
/// a piece.
double largest_deviation(const EcamResult& result);

/// Where a table ends, to the pulse.
struct TableEnd {
  std::int32_t master = 0;  ///< above 0
  std::int32_t slave = 0;
};

/// The rows of a profile: every boundary of its pieces, and the rest of `resolution` inside the curved ones,
/// evenly. The master is rounded first and the slave taken there. Rows that round to the same master are one.
/// Nullopt if a curved piece would be left without a row inside, or the master's end is not above 0.
std::optional<std::vector<CamTableRow>> sample_rows(const CamProfile& profile, const TableEnd& end,
                                                    int resolution);

}  // namespace drycut::devices::lx3vp
