#include "sim/studies/bode/speed_loop.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sim/loop/names.hpp"
#include "sim/studies/bode/sweep.hpp"

namespace drycut::sim::studies {

namespace {

/// The servo that the request means: a plant and its row of parameters.
const scenario::PlantEntry* servo_of(const scenario::Scenario& scenario, const LoopRequest& request,
                                     loop::Simulation& simulation, Problems& problems) {
  const auto plant = request.wire.substr(0, request.wire.find('.'));
  std::vector<const scenario::PlantEntry*> servos;
  std::vector<std::string> names;
  for (const auto& entry : scenario.plants) {
    if (!simulation.names().reading(entry.name.text + ".servo.asked")) continue;
    if (!plant.empty() && entry.name.text != plant) continue;
    servos.push_back(&entry);
    names.push_back(entry.name.text + ".servo.reference");
  }
  if (servos.size() == 1) return servos.front();
  problems.push_back(
      servos.empty() ? Problem{"bode.no-loop"_code, scenario.file.string(), 1, 1,
                               "no servo has a speed loop to measure", "a plant with drive: servo or pulses"}
                     : Problem{"option.missing"_code, "--wire", 1, 1, "the scenario has more than one servo",
                               fmt::format("give one of: {}", fmt::join(names, ", "))});
  return nullptr;
}

double parameter_of(const scenario::PlantEntry& plant, const std::string& name) {
  for (const auto& row : plant.definition->parameters())
    if (row.name == name) return *std::get<double*>(row.value);
  return 0;
}

plants::TorqueFilterData filters_of(const scenario::PlantEntry& plant) {
  plants::TorqueFilterData filters;
  filters.low_pass = parameter_of(plant, "servo.torque_filter");
  for (std::size_t i = 0; i < filters.notches.size(); ++i) {
    const auto value = [&](const char* what) {
      return parameter_of(plant, fmt::format("servo.notch{}.{}", i + 1, what));
    };
    filters.notches[i] = {value("frequency"), value("depth"), value("width")};
  }
  return filters;
}

/// Two runs in step, one with the test signal.
struct SpeedTwins {
  loop::Simulation& excited;
  loop::Simulation& still;
  std::function<void(double)> add;
  std::function<double()> asked;
  std::function<double()> undisturbed;

  [[nodiscard]] bool advance(double torque) {
    add(torque);
    const bool whole = excited.advance();
    return still.advance() && whole;
  }
};

bool measure_tone(SpeedTwins& twins, const TestTone& tone, double amplitude, BodePoint& point) {
  const auto settle = std::max<std::int64_t>(2 * tone.samples / tone.cycles, 500);
  Correlator output(tone.cycles, tone.samples);
  Correlator total(tone.cycles, tone.samples);
  const std::int64_t lead = tone.samples - settle % tone.samples;
  for (std::int64_t k = 0; k < settle + tone.samples; ++k) {
    const double added = amplitude * cosine_at(tone.cycles, tone.samples, lead + k);
    if (!twins.advance(added)) return false;
    if (k < settle) continue;
    const double answer = twins.asked() - twins.undisturbed();
    output.add(answer);
    total.add(answer + added);
  }
  point.open_loop = -output.tone() / total.tone();
  point.error = std::hypot(output.error(), total.error());
  return true;
}

/// Lowest and highest frequency [Hz].
std::pair<double, double> range_of(const scenario::Scenario& scenario, const LoopRequest& request) {
  constexpr double lowest = 2;
  return {request.from.value_or(lowest), request.to.value_or(0.25 / seconds(scenario.scene.step))};
}

}  // namespace

void check_speed_range(const scenario::Scenario& scenario, const LoopRequest& request, Problems& problems) {
  const auto [from, to] = range_of(scenario, request);
  check_range(from, to, scenario.scene.step, problems);
  if (request.points.value_or(least_speed_points) < least_speed_points)
    problems.push_back(
        {"option.out-of-range"_code, "--points", 1, 1,
         fmt::format("between {} frequencies --advise would miss a resonance", *request.points),
         fmt::format("give {} to 1000", least_speed_points)});
}

std::optional<SpeedLoop> measure_speed_loop(const scenario::Scenario& scenario, const LoopRequest& request,
                                            Problems& problems, const std::function<void(double)>& progress) {
  const auto before = problems.size();
  loop::Simulation excited(scenario, problems);
  if (problems.size() > before) return {};
  const auto* const servo = servo_of(scenario, request, excited, problems);
  if (servo == nullptr) return {};
  loop::Simulation still(scenario, problems);
  if (problems.size() > before) return {};
  for (auto* simulation : {&excited, &still}) disarm(*simulation);
  SpeedLoop measured;
  measured.drive = servo->name.text + ".servo";
  measured.step = seconds(scenario.scene.step);
  measured.speed_gain = parameter_of(*servo, "servo.speed_gain");
  measured.amplitude = test_share * parameter_of(*servo, "servo.rated_torque");
  measured.filters = filters_of(*servo);
  SpeedTwins twins{excited, still, excited.names().target(measured.drive + ".test_torque")->write,
                   excited.names().reading(measured.drive + ".asked")->read,
                   still.names().reading(measured.drive + ".asked")->read};
  const auto at = start_of(scenario, request);
  while (excited.time() < at)
    if (!twins.advance(0)) break;
  constexpr double window = 2;
  const auto [from, to] = range_of(scenario, request);
  const auto tones =
      plan_tones(from, to, request.points.value_or(least_speed_points), scenario.scene.step, window);
  for (const auto& tone : tones) {
    BodePoint point;
    point.frequency = tone.frequency(scenario.scene.step);
    if (!measure_tone(twins, tone, measured.amplitude, point)) break;
    measured.points.push_back(point);
    if (progress) progress(static_cast<double>(measured.points.size()) / static_cast<double>(tones.size()));
  }
  measured.failure = excited.failure().empty() ? still.failure() : excited.failure();
  measured.lost = std::erase_if(measured.points, [](const BodePoint& point) {
    constexpr double silent = 1e-5;  // it sticks
    const double answer = std::abs(point.open_loop);
    return !std::isfinite(answer) || answer < silent || !(point.doubt() <= bode_error_limit);
  });
  return measured;
}

std::vector<BodePoint> points_with(const SpeedLoop& loop, const plants::TorqueFilterData& filters) {
  auto points = loop.points;
  for (auto& point : points)
    point.open_loop *= plants::response(filters, point.frequency, loop.step) /
                       plants::response(loop.filters, point.frequency, loop.step);
  return points;
}

}  // namespace drycut::sim::studies
