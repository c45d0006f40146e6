#include "sim/loop/odd_parameters.hpp"

#include <fmt/format.h>

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
};

}  // namespace

std::vector<std::string> odd_parameters(devices::Controller& controller) {
  constexpr double slow_ns = 20e6;
  std::vector<std::string> found;
  for (const auto& loop : controller.position_loops()) {
    const auto value = [&](const char* name) {
      const auto parameter = controller.find(fmt::format("{}.{}", loop.name, name));
      return parameter ? parameter->read() : std::nan("");
    };
    for (const auto& [name, is_odd, why] : rows)
      if (const double is = value(name); is_odd(is, value))
        found.push_back(fmt::format("{}.{} is {:g}: {}", loop.name, name, is, why));
    const auto period = loop.reference ? static_cast<double>(controller.output_period(*loop.reference)) : 0;
    if (period > slow_ns)
      found.push_back(fmt::format("{} is sampled every {:g} ms, too rarely for a position loop", loop.name,
                                  period * 1e-6));
  }
  return found;
}

}  // namespace drycut::sim::loop
