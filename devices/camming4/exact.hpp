#pragma once
#include <cstdint>

namespace drycut::devices::camming4 {

// Exact positions (spec qem.md 1.4, 8.4). An axis has `measure` Um for every `pulse` bits x4. Both a whole Um
// and a whole bit are whole numbers of the *grain*, 1/(measure*pulse) of `measure` Um: 1 Um = `pulse` grains,
// 1 bit = `measure` grains. A device's posit is trunc(grains / pulse), its count is grains / measure.

/// Resolution of one axis. Values outside 1..2^30 act as the nearest of the two, so that nothing overflows.
struct Resolution {
  std::int64_t measure = 1;  ///< [Um], and grains a bit
  std::int64_t pulse = 1;    ///< [bits x4], and grains a Um
  bool operator==(const Resolution&) const = default;
};
Resolution usable(Resolution resolution);

/// A length in grains. The fraction, 0 <= fraction < 1, is other than 0 only after arcs, whose length is
/// irrational, and after a change of a gearing's ratio.
struct Space {
  std::int64_t grains = 0;
  double fraction = 0;
  bool operator==(const Space&) const = default;
};

/// A position: whole bits x4 and a remainder, 0 <= part < measure, 0 <= fraction < 1 [grains]. Bits and
/// remainder are apart so that no run, however long, leaves 64 bits.
struct Point {
  std::int64_t bits = 0;
  std::int64_t part = 0;
  double fraction = 0;
  bool operator==(const Point&) const = default;
};

/// Sums, differences and products that stay at +-2^61 where they would pass it: hostile tables are wrong, not
/// undefined.
inline constexpr std::int64_t grain_limit = std::int64_t{1} << 61;
std::int64_t add(std::int64_t a, std::int64_t b);
std::int64_t subtract(std::int64_t a, std::int64_t b);
std::int64_t multiply(std::int64_t a, std::int64_t b);

/// A length of `grains`, any real number, limited to +-2^61.
Space space(double grains);
Space operator+(Space a, Space b);
Space operator-(Space a);
bool operator<(const Space& a, const Space& b);
double to_double(const Space& length);  ///< [grains]

/// The point `length` further on.
Point moved(const Point& point, Space length, std::int64_t measure);
/// The point of a bit count with a fraction of a bit.
Point point(std::int64_t bits, double fraction, std::int64_t measure);
/// Length from `from` to `to`.
Space between(const Point& from, const Point& to, std::int64_t measure);

}  // namespace drycut::devices::camming4
