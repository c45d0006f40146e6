#include "sim/studies/bode/advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <numbers>
#include <utility>

#include "renders/report.hpp"
#include "sim/loop/names.hpp"
#include "sim/report/report.hpp"
#include "sim/studies/bode/report.hpp"
#include "sim/studies/bode/sweep.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double percent = 100;

plants::NotchData no_notch() { return {}; }

/// Gains [dB] and phases [deg] of the loop with other filters.
struct Curve {
  std::vector<double> gains;
  std::vector<double> angles;
};

std::vector<BodePoint> points_with(const SpeedLoop& loop, const plants::TorqueFilterData& filters) {
  auto points = loop.points;
  for (auto& point : points)
    point.open_loop *= plants::response(filters, point.frequency, loop.step) /
                       plants::response(loop.filters, point.frequency, loop.step);
  return points;
}

Curve curve_of(const std::vector<BodePoint>& points) {
  Curve curve;
  std::vector<std::complex<double>> open;
  for (const auto& point : points) {
    open.push_back(point.open_loop);
    curve.gains.push_back(decibels(point.open_loop));
  }
  curve.angles = phases(open);
  return curve;
}

/// Of a closed loop at some factor of its gain.
struct Closed {
  double sensitivity = 0;  ///< largest
  double turned = 0;       ///< by which 1 + L turns from the first frequency to the last [rad]
  double left = 0;         ///< |L| at the last frequency
};

Closed closed(const std::vector<BodePoint>& points, double factor) {
  Closed loop;
  std::complex<double> before;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto now = 1.0 + factor * points[i].open_loop;
    loop.sensitivity = std::max(loop.sensitivity, 1 / std::abs(now));
    if (i > 0) loop.turned += std::arg(now / before);
    before = now;
  }
  if (!points.empty()) loop.left = factor * std::abs(points.back().open_loop);
  return loop;
}

/// The largest factor of gain, from the gain in force on, that keeps the sensitivity: it goes up from there,
/// or down to where it is kept. `turned`: as the loop turns that was measured, which is stable; one that
/// turns otherwise goes round -1 (Nyquist). What comes after the last frequency is not known: little may be
/// left there.
double most_gain(const std::vector<BodePoint>& points, double turned) {
  constexpr double step = 1.1;
  constexpr double most_left = 0.4;
  const auto is_kept = [&](double factor) {
    const auto loop = closed(points, factor);
    return loop.sensitivity <= kept_sensitivity && loop.left <= most_left &&
           std::abs(loop.turned - turned) < std::numbers::pi / 2;
  };
  double kept = 1;
  if (!is_kept(kept)) {
    while (kept > 1 / largest_factor && !is_kept(kept)) kept /= step;
    if (!is_kept(kept)) return 1 / largest_factor;
  } else {
    while (kept < largest_factor && is_kept(kept * step)) kept *= step;
  }
  double over = kept * step;
  for (int i = 0; i < 12; ++i) {
    const double middle = std::sqrt(kept * over);
    (is_kept(middle) ? kept : over) = middle;
  }
  return kept;
}

/// The least of it with the filters a little beside their place, for no machine resonates where it was
/// measured.
double most_gain(const SpeedLoop& loop, const plants::TorqueFilterData& filters) {
  constexpr double beside = 0.05;
  const double turned = closed(loop.points, 1).turned;
  double least = largest_factor;
  for (const double times : {1 - beside, 1.0, 1 + beside}) {
    auto moved = filters;
    moved.low_pass /= times;
    for (auto& notch : moved.notches) notch.frequency *= times;
    least = std::min(least, most_gain(points_with(loop, moved), turned));
  }
  return least;
}

/// The same for who chooses filters: none that costs the loop more phase at the gain in force than may be, or
/// any of its gain margin.
double most_with(const SpeedLoop& loop, const Margins& present, const plants::TorqueFilterData& filters) {
  const auto margins = margins_of(points_with(loop, filters));
  const auto short_of = [](const std::optional<AtFrequency>& now, const std::optional<AtFrequency>& before,
                           double less) {
    return before ? std::max(0.0, before->value - less - (now ? now->value : before->value)) : 0;
  };
  // Steep, so that the search finds back.
  const double over =
      short_of(margins.phase, present.phase, most_cost) + short_of(margins.gain, present.gain, 0);
  return std::log(most_gain(loop, filters)) - over;
}

/// A kind of filter with its values as numbers from 0 to 1.
struct Family {
  std::size_t values;
  std::function<plants::TorqueFilterData(const std::vector<double>&)> filters;
};

double between(double low, double high, double share) { return low * std::pow(high / low, share); }

plants::NotchData notch_of(const SpeedLoop& loop, const std::vector<double>& x, std::size_t at) {
  const double highest = std::min(0.2 / loop.step, loop.points.back().frequency);
  return {between(10, highest, x[at]), between(0.03, 0.7, x[at + 1]), between(0.2, 1, x[at + 2])};
}

/// The best of a family: every corner of a grid, then downhill from the best.
FilterChoice best_of(const SpeedLoop& loop, const Margins& present, const Family& family) {
  const auto value = [&](const std::vector<double>& x) {
    return most_with(loop, present, family.filters(x));
  };
  std::vector<double> start;
  {
    const int sides = family.values == 1 ? 60 : 24;
    std::vector<double> x(family.values, 0);
    double best = -1e9;
    std::vector<int> place(family.values, 0);
    const auto steps = [&](std::size_t i) { return i == 0 ? sides : 4; };
    for (bool more = true; more;) {
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = place[i] / static_cast<double>(steps(i));
      if (const double now = value(x); now > best) {
        best = now;
        start = x;
      }
      more = false;
      for (std::size_t i = 0; i < place.size() && !more; ++i) {
        more = place[i] < steps(i);
        place[i] = more ? place[i] + 1 : 0;
      }
    }
  }
  nlopt::opt method(nlopt::LN_SBPLX, static_cast<unsigned>(family.values));
  method.set_lower_bounds(0);
  method.set_upper_bounds(1);
  method.set_xtol_abs(1e-4);
  method.set_maxeval(600);
  method.set_initial_step(0.05);
  std::function<double(const std::vector<double>&, std::vector<double>&)> target =
      [&](const std::vector<double>& x, std::vector<double>&) { return value(x); };
  method.set_max_objective([](const std::vector<double>& x, std::vector<double>& gradient,
                              void* data) { return (*static_cast<decltype(target)*>(data))(x, gradient); },
                           &target);
  double found = 0;
  try {
    method.optimize(start, found);
  } catch (const nlopt::roundoff_limited&) {  // it is where it can be
  }
  return judged_with(loop, family.filters(start));
}

std::string filter_text(const plants::TorqueFilterData& filters) {
  std::vector<std::string> parts;
  if (filters.low_pass > 0) parts.push_back(fmt::format("torque_filter: {:.3g} ms", filters.low_pass * 1e3));
  for (std::size_t i = 0; i < filters.notches.size(); ++i) {
    const auto& notch = filters.notches[i];
    if (notch.frequency > 0)
      parts.push_back(fmt::format("notch{}: {{frequency: {:.4g} Hz, depth: {:.2g}, width: {:.2g}}}", i + 1,
                                  notch.frequency, notch.depth, notch.width));
  }
  return parts.empty() ? "no filter" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string margin_text(const std::optional<AtFrequency>& margin, const char* unit) {
  return margin ? fmt::format("{:.1f} {} at {}", margin->value, unit, hertz_text(margin->frequency)) : "none";
}

std::vector<std::string> cells_of(const FilterAdvice& advice, const FilterChoice& choice) {
  auto gain = margin_text(choice.margins.gain, "dB");
  if (const auto& down = choice.margins.gain_down)
    gain += fmt::format("; downwards {:.1f} dB at {}", down->value, hertz_text(down->frequency));
  return {filter_text(choice.filters), std::move(gain), margin_text(choice.margins.phase, "deg"),
          fmt::format("{:.0f} rad/s", choice.factor * advice.loop.speed_gain)};
}

renders::ReportTable table_of(const FilterAdvice& advice) {
  renders::ReportTable table{"Filters of the torque",
                             {"servo:", "gain margin", "phase margin",
                              fmt::format("largest speed_gain with a sensitivity of {:g}", kept_sensitivity)},
                             {}};
  table.rows.push_back({cells_of(advice, advice.present)});
  table.rows.back().cells[0] += " (present)";
  for (const auto& choice : advice.choices) table.rows.push_back({cells_of(advice, choice)});
  return table;
}

std::string sentence_of(const FilterAdvice& advice) {
  const auto& loop = advice.loop;
  if (!loop.failure.empty()) return "the simulation stopped: " + loop.failure;
  if (loop.points.empty()) return "the speed loop does not answer";
  if (advice.present.factor > 0.999 * largest_factor)
    return fmt::format(
        "{}: nothing limits its speed_gain up to {:g} times; where dry friction or play holds the motor, "
        "measure "
        "it in motion (--at)",
        loop.drive, largest_factor);
  if (advice.present.factor >= ample_factor)
    return fmt::format("{}: it needs no filter: speed_gain may go from {:g} to {:.0f} rad/s as it is",
                       loop.drive, loop.speed_gain, advice.present.factor * loop.speed_gain);
  const auto& best = advice.choices.front();
  if (!advice.worth())
    return fmt::format("{}: no filter lets its speed_gain go up by more than 1 dB", loop.drive);
  const auto gained = [&]() -> std::string {
    const auto& before = advice.present.margins.gain;
    const auto& after = best.margins.gain;
    return before && after ? fmt::format("{:+.1f} dB of gain margin", after->value - before->value)
                           : "no gain margin between these frequencies";
  };
  const auto cost = [&]() -> std::string {
    const auto& before = advice.present.margins.phase;
    const auto& after = best.margins.phase;
    return before && after ? fmt::format("{:+.1f} deg of phase margin", after->value - before->value)
                           : "no phase margin to compare";
  };
  return fmt::format("{}: {}; {}, {}; speed_gain up to {:.0f} rad/s, without a filter up to {:.0f}; now {:g}",
                     loop.drive, filter_text(best.filters), gained(), cost(), best.factor * loop.speed_gain,
                     advice.present.factor * loop.speed_gain, loop.speed_gain);
}

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

}  // namespace

bool FilterAdvice::worth() const {
  constexpr double little = 1.122;  // 1 dB
  return !choices.empty() && present.factor < ample_factor &&
         choices.front().factor > little * present.factor;
}

FilterChoice judged_with(const SpeedLoop& loop, const plants::TorqueFilterData& filters) {
  return {filters, margins_of(points_with(loop, filters)), most_gain(loop, filters)};
}

FilterAdvice advise(SpeedLoop measured) {
  FilterAdvice advice;
  advice.loop = std::move(measured);
  const auto& loop = advice.loop;
  if (loop.points.empty()) return advice;
  advice.present = judged_with(loop, loop.filters);
  const Family low_pass = {
      1, [&](const std::vector<double>& x) {
        return plants::TorqueFilterData{between(loop.step, 20e-3, x[0]), {no_notch(), no_notch()}};
      }};
  const Family notch = {3, [&](const std::vector<double>& x) {
                          return plants::TorqueFilterData{0, {notch_of(loop, x, 0), no_notch()}};
                        }};
  advice.choices = {best_of(loop, advice.present.margins, low_pass),
                    best_of(loop, advice.present.margins, notch)};
  // A second one beside the first.
  const auto first = advice.choices[1].filters.notches[0];
  const Family second = {3, [&](const std::vector<double>& x) {
                           return plants::TorqueFilterData{0, {first, notch_of(loop, x, 0)}};
                         }};
  advice.choices.push_back(best_of(loop, advice.present.margins, second));
  // What takes more filters must gain for it.
  constexpr double for_another = 1.122;
  const auto merit = [](const FilterChoice& choice) {
    const auto& [low, notches] = choice.filters;
    const int count =
        (low > 0 ? 1 : 0) + (notches[0].frequency > 0 ? 1 : 0) + (notches[1].frequency > 0 ? 1 : 0);
    return choice.factor / std::pow(for_another, count - 1);
  };
  std::stable_sort(advice.choices.begin(), advice.choices.end(),
                   [&](const auto& a, const auto& b) { return merit(a) > merit(b); });
  return advice;
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
  measured.amplitude = 0.05 * parameter_of(*servo, "servo.rated_torque");
  measured.filters = filters_of(*servo);
  SpeedTwins twins{excited, still, excited.names().target(measured.drive + ".test_torque")->write,
                   excited.names().reading(measured.drive + ".asked")->read,
                   still.names().reading(measured.drive + ".asked")->read};
  const auto at = start_of(scenario, request);
  while (excited.time() < at)
    if (!twins.advance(0)) break;
  constexpr double lowest = 2;
  constexpr double window = 2;
  constexpr int points = 360;  // a resonance has some in its width
  const auto tones = plan_tones(request.from.value_or(lowest), request.to.value_or(0.25 / measured.step),
                                std::max(request.points, points), scenario.scene.step, window);
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

std::string advice_text(const FilterAdvice& advice) {
  std::string text =
      fmt::format("{}: a sine of {:.3g} N m added to the torque that its speed loop asks for\n",
                  advice.loop.drive, advice.loop.amplitude);
  if (!advice.loop.points.empty()) text += renders::rows_text(table_of(advice), 0);
  return text + sentence_of(advice) + "\n";
}

record::Verdict verdict_of(const FilterAdvice& advice) {
  record::Verdict verdict;
  verdict.title = "Filters for " + advice.loop.drive;
  verdict.word = "MEASURED";
  if (advice.loop.points.empty()) verdict.judge(false);
  if (!advice.loop.failure.empty()) verdict.stopped();
  verdict.sentence = sentence_of(advice);
  verdict.counts = {{"frequencies", std::ssize(advice.loop.points)}};
  return verdict;
}

void write_advice_report(const FilterAdvice& advice, const scenario::Scenario& scenario,
                         OutputFolder& folder) {
  auto report = report::page_of(verdict_of(advice));
  report.scenario = scenario.file.filename().string();
  report.facts = {
      {{"measured",
        fmt::format("a sine of {:.3g} N m, {:.0f} % of rated torque, at {} frequencies from {} to {}; {} "
                    "left out where "
                    "the answer was lost in what else moves",
                    advice.loop.amplitude, 0.05 * percent, advice.loop.points.size(),
                    advice.loop.points.empty() ? "" : hertz_text(advice.loop.points.front().frequency),
                    advice.loop.points.empty() ? "" : hertz_text(advice.loop.points.back().frequency),
                    advice.loop.lost)}},
      {{"reading", "those of the simulated loop: a drive's own dead time comes on top"}},
      {{"drycut", DRYCUT_VERSION}}};
  report::add_overrides(scenario.overrides, report);
  report.scenario_expanded = scenario::expand(scenario);
  if (advice.loop.points.empty()) return report::write_report(std::move(report), {}, folder);
  report.summary = {table_of(advice)};
  if (advice.worth())
    report.texts = {
        {"To paste",
         fmt::format("# It costs phase, and gains where speed_gain goes up: to {:.0f} rad/s at most\n"
                     "plants:\n  {}:\n    servo: {{{}}}\n",
                     advice.choices.front().factor * advice.loop.speed_gain,
                     advice.loop.drive.substr(0, advice.loop.drive.find('.')),
                     filter_text(advice.choices.front().filters))}};
  auto plot = empty_bode_plot("speed_loop", advice.loop.drive + ": open speed loop");
  auto& gain = plot.panels[0];
  auto& phase = plot.panels[1];
  const auto draw = [&](const std::string& label, const FilterChoice& choice) {
    const auto points = points_with(advice.loop, choice.filters);
    const auto [gains, angles] = curve_of(points);
    std::vector<double> x;
    x.reserve(points.size());
    for (const auto& point : points) x.push_back(point.frequency);
    gain.curves.push_back({label, x, gains});
    phase.curves.push_back({label, x, angles});
  };
  draw("present", advice.present);
  draw("advised", advice.choices.front());
  report::write_report(std::move(report), {std::move(plot)}, folder);
}

}  // namespace drycut::sim::studies
