#include "sim/loop/odd_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

namespace drycut::sim::loop {

namespace {

/// A parameter's value by its name; not a number where the axis has none of that name.
using Value = std::function<double(const char*)>;

struct OddRow {
  const char* parameter;
  bool (*is_odd)(double value, const Value& other);
  const char* why;
};

constexpr double all_speed = 1000;    // feedfw: the reference is the whole speed
constexpr double full_scale = 32767;  // offset: 10 V
constexpr double much_offset = 0.05;  // of it
constexpr double long_delay = 200;    // 1/100 s
constexpr double long_ramp = 1e6;     // us
constexpr double slow_start = 10;     // s
constexpr double low_gain = 8;        // 1/s: it takes a third of a second to come to rest
constexpr OddRow rows[] = {
    {"feedfw", [](double value, const Value&) { return value > 0 && value < all_speed / 2; },
     "1000 is feed forward of the whole speed"},
    {"feedfw", [](double value, const Value&) { return value > 1.5 * all_speed; },
     "1000 is feed forward of the whole speed"},
    {"pgain", [](double value, const Value& other) { return value == 0 && other("integt") == 0; },
     "nothing corrects the following error"},
    {"offset", [](double value, const Value&) { return std::abs(value) > much_offset * full_scale; },
     "it stands on the output always, 32767 is 10 V"},
    {"tacc", [](double value, const Value& other) { return value == 0 && other("rampmode") == 1; },
     "with rampmode 1 the axis accelerates without a ramp"},
    {"tdec", [](double value, const Value& other) { return value == 0 && other("rampmode") == 1; },
     "with rampmode 1 the axis brakes without a ramp"},
    {"taccdec", [](double value, const Value& other) { return value == 0 && other("rampmode") != 1; },
     "the axis moves without ramps"},
    {"tbrake", [](double value, const Value&) { return value > long_delay; }, "it is in 1/100 s"},
    {"tinvt", [](double value, const Value&) { return value > long_delay; }, "it is in 1/100 s"},
    {"slowdly", [](double value, const Value&) { return value > long_delay; }, "it is in 1/100 s"},
    {"slowpos",
     [](double value, const Value& other) {
       const double coasted = std::max(other("iner01"), other("iner02")) / 10;
       return other("slowtype") == 0 && coasted > value / 2;
     },
     "it coasts half of that way and more (iner01, iner02), so it was hardly slow when its outputs went off"},
    {"maxvel", [](double value, const Value& other) { return value == 0 && other("slowtype") > 0; },
     "with this slowtype the slow range is a share of it"},
    {"kv", [](double value, const Value&) { return value > 0 && value < 100 * low_gain; },
     "in 0.01/s, and position loops of drives have 2000 to 10000"},
    {"dynamik.tr_min", [](double value, const Value&) { return value > long_ramp; },
     "the acceleration is built up in no less, and the axis brakes as slowly"},
    {"dynamik.a_max",
     [](double value, const Value& other) {
       return value > 0 && other("dynamik.vb_max") > 1000 * slow_start * value;
     },
     "in mm/s2, and so it takes more than 10 s from rest to dynamik.vb_max"},
};

// What an axis may well do without: told where nothing else is.
constexpr OddRow plain_rows[] = {
    {"feedfw", [](double value, const Value& other) { return value == 0 && other("pgain") > 0; },
     "the following error grows with the speed"},
    {"inertmode", [](double value, const Value&) { return value == 0; }, "the axis learns nothing"},
};

}  // namespace

std::vector<Finding> odd_parameters(devices::Controller& controller) {
  constexpr double slow_ns = 10e6;
  std::vector<Finding> found;
  const auto value_of = [&](const std::string& axis, const char* name) {
    const auto parameter = controller.find(fmt::format("{}.{}", axis, name));
    return parameter ? parameter->read() : std::nan("");
  };
  const auto tell = [&](const std::string& axis, std::span<const OddRow> odd) {
    const auto value = [&](const char* name) { return value_of(axis, name); };
    for (const auto& [name, is_odd, why] : odd)
      if (const double is = value(name); is_odd(is, value))
        found.emplace_back("loop.odd-parameter"_code, fmt::format("{}.{} is {:g}: {}", axis, name, is, why));
  };
  for (const auto& loop : controller.position_loops()) {
    tell(loop.name, rows);
    auto period = loop.reference ? static_cast<double>(controller.output_period(*loop.reference)) : 0;
    if (!loop.reference)  // all its axes have one
      for (const auto& one : controller.periods())
        if (one.samples_axes) period = std::max(period, static_cast<double>(one.ns));
    const double gain = period > 0 ? value_of(loop.name, "pgain") / 1000 / (period * 1e-9) : std::nan("");
    if (gain > 0 && gain < low_gain)
      found.emplace_back(
          "loop.odd-parameter"_code,
          fmt::format("{0}.pgain is {1:g}, every {2:g} ms: a gain of {3:.3g} 1/s, and position "
                      "loops of drives have 20 to 100",
                      loop.name, value_of(loop.name, "pgain"), period * 1e-6, gain));
    if (period > slow_ns)
      found.emplace_back("loop.odd-parameter"_code,
                         fmt::format("{} is sampled every {:g} ms, too rarely for a position loop", loop.name,
                                     period * 1e-6));
  }
  for (const auto& loop : controller.position_loops()) tell(loop.name, plain_rows);
  return found;
}

std::vector<Finding> rarely_sampled(devices::Controller& controller) {
  constexpr std::int64_t rare_ns = 50'000'000;
  std::vector<Finding> found;
  for (const auto& period : controller.periods())
    if (period.samples_axes && period.ns > rare_ns)
      found.emplace_back("loop.rarely-sampled"_code,
                         fmt::format("{} is {:g} s, far too long for a position loop", period.name,
                                     static_cast<double>(period.ns) * 1e-9));
  return found;
}

}  // namespace drycut::sim::loop
