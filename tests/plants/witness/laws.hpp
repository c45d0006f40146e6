#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "plants/end_stop.hpp"
#include "plants/motor_load.hpp"
#include "plants/servo_drive.hpp"
#include "plants/transmission.hpp"

// What the machines have in common, written once more from what the parameters mean and as equations of
// continuous time: none of the plants' functions is used, only their parameters. y' = f(y), in SI.

namespace drycut::plants::witness {

/// Where motor and load of a machine were, a sample every millisecond, both as travel of the load [m].
struct Track {
  std::vector<double> motor;
  std::vector<double> load;

  [[nodiscard]] double travel() const {
    const auto [least, most] = std::minmax_element(load.begin(), load.end());
    return *most - *least;
  }
};
/// What a machine is told over a while: a reference that goes evenly from one voltage to another, and a
/// force of the process.
struct Leg {
  double until;      ///< [s], whole milliseconds
  double from;       ///< [V]
  double to;         ///< [V]
  double force = 0;  ///< on the guided part [N]
};
struct Motion {
  std::vector<Leg> legs;
  std::size_t leg = 0;  ///< that is on

  [[nodiscard]] double began() const { return leg == 0 ? 0 : legs[leg - 1].until; }
  [[nodiscard]] double volts(double t) const {
    const Leg& now = legs[leg];
    return now.from + (now.to - now.from) * (t - began()) / (now.until - began());
  }
  [[nodiscard]] double force() const { return legs[leg].force; }
  /// Goes on to the leg that follows `t`; true if that is another one.
  bool follow(double t) {
    if (leg + 1 == legs.size() || t < legs[leg].until - 1e-9) return false;
    ++leg;
    return true;
  }
};

/// A servo with speed reference; the plant's is plants/servo_drive.cpp. With the reference filter's time tf,
/// the current loop's tc and the gain K = (1 + inertia ratio) rotor inertia speed gain:
///   r' = (speed per volt u - r) / tf       reference
///   p = K (r - speed) + i                  what the loop asks for
///   i' = K / Ti (r - speed)                stands while the limit acts and the error drives it further in
///   T' = (p within the limits - T) / tc    torque
/// Where p would leave the limit with the integral running and fall below it with the integral standing, the
/// integral runs just so fast that p stays along the limit. The ADC is taken as ideal.
/// Ahead of the loop, added to p, is the share c of the torque for the reference's acceleration:
///   a' = (r' - a) / ta,  p += c (1 + inertia ratio) rotor inertia a
/// The filters make w of p, and w is what the limit and the current loop get. A low-pass of time tl, and
/// notches at the angular frequency W, of depth d and width b, each
///   (s2 + d b W s + W2) / (s2 + b W s + W2) = 1 + (d - 1) b W s / (s2 + b W s + W2):
///   l' = (p - l) / tl
///   x' = W z,  z' = W (l - x - b z),  w = l + (d - 1) b z
/// With filters or a torque ahead the integral is not asked to keep w along the limit: that is right for a
/// low-pass, whose w lags; with a notch or a torque ahead a motion is to stay within the limit.
/// On the rotor are T, cogging C sin(n angle) and ripple R T sin(m angle).
struct Servo {
  enum State { reference, integral, torque, acceleration, low, first_notch };
  /// What it is told and what its motor does.
  struct Input {
    double volts;         ///< [V]
    double speed;         ///< [rad/s]
    double acceleration;  ///< [rad/s2]
  };
  ServoData data;
  enum class Limit { within, beyond, along } at = Limit::within;

  [[nodiscard]] double gain() const {
    return (1 + data.inertia_ratio) * data.rotor_inertia * data.speed_gain;
  }
  [[nodiscard]] bool ahead() const { return data.torque_forward > 0; }
  [[nodiscard]] bool plain() const { return !ahead() && !data.filters.any(); }
  [[nodiscard]] std::size_t states() const { return plain() ? acceleration : first_notch + 4; }

  /// By the loop and ahead of it, before the filters.
  [[nodiscard]] double unfiltered(const Input& in, std::span<const double> y) const {
    const double loop = gain() * (y[reference] - in.speed) + y[integral];
    if (!ahead()) return loop;
    return loop + data.torque_forward * gain() / data.speed_gain * y[acceleration];
  }
  /// Before each notch, and last behind them.
  [[nodiscard]] std::array<double, 3> along_filters(const Input& in, std::span<const double> y) const {
    const double p = unfiltered(in, y);
    if (plain()) return {p, p, p};
    std::array<double, 3> passed = {data.filters.low_pass > 0 ? y[low] : p};
    for (std::size_t i = 0; i < 2; ++i) {
      const NotchData& notch = data.filters.notches[i];
      const double z = y[first_notch + 2 * i + 1];
      passed[i + 1] = passed[i] + (notch.frequency > 0 ? (notch.depth - 1) * notch.width * z : 0);
    }
    return passed;
  }
  [[nodiscard]] double asked(const Input& in, std::span<const double> y) const {
    return along_filters(in, y).back();
  }
  void filter_slope(const Input& in, std::span<const double> y, std::span<double> dy) const {
    const auto passed = along_filters(in, y);
    dy[acceleration] = ahead() ? (reference_rate(in, y) - y[acceleration]) / data.torque_forward_filter : 0;
    dy[low] = data.filters.low_pass > 0 ? (unfiltered(in, y) - y[low]) / data.filters.low_pass : 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const NotchData& notch = data.filters.notches[i];
      const double middle = 2 * std::numbers::pi * notch.frequency;
      const std::size_t x = first_notch + 2 * i;
      dy[x] = middle * y[x + 1];
      dy[x + 1] = middle * (passed[i] - y[x] - notch.width * y[x + 1]);
    }
  }
  /// On a rotor at `angle` [rad].
  [[nodiscard]] double on_rotor(double angle, std::span<const double> y) const {
    return y[torque] * (1 + data.torque_ripple * std::sin(data.torque_ripple_periods * angle)) +
           data.cogging * std::sin(data.cogging_periods * angle);
  }
  /// Fall of the limit with the speed of a motor that is driven above rated speed [N m s/rad].
  [[nodiscard]] double fall(const Input& in, double asked) const {
    const bool falls = std::abs(in.speed) > data.rated_speed && asked * in.speed > 0;
    return falls ? (data.peak_torque - data.torque_at_max_speed) / (data.max_speed - data.rated_speed) : 0;
  }
  [[nodiscard]] double limit(const Input& in, double asked) const {
    return data.peak_torque - fall(in, asked) * (std::abs(in.speed) - data.rated_speed);
  }
  [[nodiscard]] double reference_rate(const Input& in, std::span<const double> y) const {
    return ((in.volts + data.offset) * data.speed_at_10v / 10 - y[reference]) / data.filter;
  }
  [[nodiscard]] double winding(const Input& in, std::span<const double> y) const {
    return gain() / data.integral_time * (y[reference] - in.speed);
  }
  /// Rate of the integral that keeps p along the limit.
  [[nodiscard]] double keeping(const Input& in, std::span<const double> y) const {
    return -gain() * (reference_rate(in, y) - in.acceleration) - fall(in, asked(in, y)) * in.acceleration;
  }
  void slope(const Input& in, std::span<const double> y, std::span<double> dy) const {
    const double p = asked(in, y);
    const double most = limit(in, p);
    const bool stands = at == Limit::beyond && p * (y[reference] - in.speed) >= 0;
    dy[reference] = reference_rate(in, y);
    dy[integral] = at == Limit::along ? keeping(in, y) : stands ? 0 : winding(in, y);
    dy[torque] = (std::clamp(p, -most, most) - y[torque]) / data.current_lag;
    if (!plain()) filter_slope(in, y, dy);
  }

  [[nodiscard]] double watch(const Input& in, std::span<const double> y) const {
    const double p = asked(in, y);
    const double over = std::abs(p) - limit(in, p);
    const double side = p > 0 ? 1 : -1;
    if (at == Limit::within) return over - hair;
    if (at == Limit::beyond) return -over - hair;
    return std::max(side * (keeping(in, y) - winding(in, y)), -side * keeping(in, y));
  }
  void act(const Input& in, std::span<double> y) {
    const double p = asked(in, y);
    const double side = p > 0 ? 1 : -1;
    if (!plain()) {
      at = at == Limit::within ? Limit::beyond : Limit::within;
      return;
    }
    if (side * keeping(in, y) < 0)
      at = Limit::beyond;
    else
      at = at != Limit::within && side * (keeping(in, y) - winding(in, y)) > 0 ? Limit::within : Limit::along;
    if (at == Limit::along) y[integral] += side * limit(in, p) - p;
  }

 private:
  static constexpr double hair = 1e-9;  // [N m]
};

/// Friction of a guided body; the plant's is plants/motor_load.hpp. Sliding it resists with
///   viscous v + sign(v) (coulomb + breakaway exp(-(v / stribeck)^2)), backwards times `viscous_backward`,
///   `backward`,
/// plus what else resists a motion that way; sticking it holds the body against all that is below that.
struct Dry {
  Friction data;
  int way = 0;  ///< that it slides, 1 or -1; 0: it sticks

  [[nodiscard]] double level(double speed) const {
    if (data.breakaway == 0) return data.coulomb;
    return data.coulomb + data.breakaway * std::exp(-std::pow(speed / data.stribeck_speed, 2));
  }
  /// Of the body, under all other efforts.
  [[nodiscard]] double acceleration(double inertia, double speed, double effort,
                                    const DryResistance& more) const {
    if (way == 0) return 0;
    const double dry = way > 0 ? level(speed) + more.forward : -level(speed) * data.backward - more.backward;
    const double viscous = way > 0 ? data.viscous : data.viscous * data.viscous_backward;
    return (effort - viscous * speed - dry) / inertia;
  }
  [[nodiscard]] double watch(double speed, double effort, const DryResistance& more) const {
    if (way != 0) return -way * speed;
    return std::max(effort - level(0) - more.forward, -effort - level(0) * data.backward - more.backward);
  }
  void act(double& speed, double effort, const DryResistance& more) {
    const bool slid = way != 0;
    const double up = effort - level(0) - more.forward;
    const double down = -effort - level(0) * data.backward - more.backward;
    if (slid) speed = 0;
    way = slid && std::max(up, down) <= 0 ? 0 : up > down ? 1 : -1;
  }
};

/// Efficiency backwards: as it is given, or that of the same friction both ways.
[[nodiscard]] inline double backwards(const Efficiency& of) {
  return of.driven > -20 ? of.driven : 2 - 1 / of.driving;
}

/// Torque of a gear on its load, seen there; the plant's is plants/transmission.cpp. Without play spring and
/// damper; with play two flanks that push with spring and damper once the twist has taken up half of it, the
/// damper held to the spring's torque both ways.
[[nodiscard]] inline double gear_torque(const TransmissionData& gear, double twist, double rate) {
  if (gear.backlash == 0) return gear.stiffness * twist + gear.damping * rate;
  const double pressed = std::abs(twist) - gear.backlash / 2;
  if (pressed <= 0) return 0;
  const double side = twist > 0 ? 1 : -1;
  const double spring = gear.stiffness * pressed;
  return side * (spring + std::clamp(side * gear.damping * rate, -spring, spring));
}

/// A buffer that only pushes: an end stop or a workpiece; the plant's is plants/end_stop.hpp.
struct Buffer {
  EndStopData data;
  double position;  ///< where it begins [m]
  double side;      ///< 1: at the upper end, -1: at the lower
  bool touched = false;

  [[nodiscard]] double depth(double x) const { return side * (x - position); }
  /// On the part [N].
  [[nodiscard]] double force(double x, double speed) const {
    if (!touched) return 0;
    return -side * std::max(0.0, data.stiffness * depth(x) + data.damping * side * speed);
  }
  [[nodiscard]] double watch(double x) const { return touched ? -depth(x) : depth(x); }
  void act() { touched = !touched; }
};

}  // namespace drycut::plants::witness
