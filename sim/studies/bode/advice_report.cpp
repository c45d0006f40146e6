#include "sim/studies/bode/advice_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <complex>
#include <utility>
#include <vector>

#include "renders/report.hpp"
#include "sim/report/report.hpp"
#include "sim/studies/bode/report.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double percent = 100;

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
        "{}: nothing limits its speed_gain up to {:g} times; "
        "where dry friction or play holds the motor, measure it in motion (--at)",
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

}  // namespace

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
        fmt::format("a sine of {:.3g} N m, {:.0f} % of rated torque, at {} frequencies from {} to {}; "
                    "{} left out where the answer was lost in what else moves",
                    advice.loop.amplitude, test_share * percent, advice.loop.points.size(),
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
    std::vector<double> frequencies;
    std::vector<double> gains;
    std::vector<std::complex<double>> responses;
    for (const auto& point : points_with(advice.loop, choice.filters)) {
      frequencies.push_back(point.frequency);
      gains.push_back(decibels(point.open_loop));
      responses.push_back(point.open_loop);
    }
    gain.curves.push_back({label, frequencies, gains});
    phase.curves.push_back({label, frequencies, phases(responses)});
  };
  draw("present", advice.present);
  draw("advised", advice.choices.front());
  report::write_report(std::move(report), {std::move(plot)}, folder);
}

}  // namespace drycut::sim::studies
