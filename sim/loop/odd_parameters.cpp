#include "sim/loop/odd_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

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
};

}  // namespace

std::vector<std::string> odd_parameters(devices::Controller& controller) {
  constexpr double slow_ns = 10e6;
  std::vector<std::string> found;
  for (const auto& loop : controller.position_loops()) {
    const auto value = [&](const char* name) {
      const auto parameter = controller.find(fmt::format("{}.{}", loop.name, name));
      return parameter ? parameter->read() : std::nan("");
    };
    for (const auto& [name, is_odd, why] : rows)
      if (const double is = value(name); is_odd(is, value))
        found.push_back(fmt::format("{}.{} is {:g}: {}", loop.name, name, is, why));
    auto period = loop.reference ? static_cast<double>(controller.output_period(*loop.reference)) : 0;
    if (!loop.reference)  // all its axes have one
      for (const auto& [name, ns] : controller.periods()) period = std::max(period, static_cast<double>(ns));
    const double gain = period > 0 ? value("pgain") / 1000 / (period * 1e-9) : std::nan("");
    if (gain > 0 && gain < low_gain)
      found.push_back(
          fmt::format("{0}.pgain is {1:g}, every {2:g} ms: a gain of {3:.3g} 1/s, and position "
                      "loops of drives have 20 to 100",
                      loop.name, value("pgain"), period * 1e-6, gain));
    if (period > slow_ns)
      found.push_back(fmt::format("{} is sampled every {:g} ms, too rarely for a position loop", loop.name,
                                  period * 1e-6));
  }
  return found;
}

}  // namespace drycut::sim::loop
