#include "sim/studies/bode/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "base/text.hpp"
#include "renders/report.hpp"
#include "sim/record/recording.hpp"
#include "sim/report/report.hpp"

namespace drycut::sim::studies {

namespace {

/// A response over all points: gain [dB] and phase [deg].
struct BodeColumns {
  std::vector<double> gain;
  std::vector<double> phase;
};

BodeColumns columns_of(const std::vector<BodePoint>& points,
                       const std::function<std::complex<double>(const BodePoint&)>& response) {
  std::vector<std::complex<double>> values;
  BodeColumns columns;
  for (const auto& point : points) {
    values.push_back(response(point));
    columns.gain.push_back(decibels(values.back()));
  }
  columns.phase = phases(values);
  return columns;
}

struct BodeTable {
  BodeColumns open;
  BodeColumns closed;
  BodeColumns sensitivity;
  BodeColumns speed;  ///< empty if not measured
};

/// The points where the loop answered.
std::vector<BodePoint> heard(const LoopResult& result) {
  auto points = result.sweep.points;
  std::erase_if(points, [](const BodePoint& point) { return point.silent; });
  return points;
}

/// Those of them where the answer is more than noise.
std::vector<BodePoint> known(const LoopResult& result) {
  auto points = heard(result);
  std::erase_if(points, [](const BodePoint& point) { return !(point.error <= bode_lost); });
  return points;
}

BodeTable table_of(const LoopResult& result, const std::vector<BodePoint>& points) {
  BodeTable table;
  table.open = columns_of(points, [](const BodePoint& p) { return p.open_loop; });
  table.closed = columns_of(points, [](const BodePoint& p) { return p.closed_loop(); });
  table.sensitivity = columns_of(points, [](const BodePoint& p) { return p.sensitivity(); });
  if (!result.speed.empty()) table.speed = columns_of(points, [](const BodePoint& p) { return *p.speed; });
  return table;
}

/// From which gain on a loop with play keeps an oscillation up.
std::string pushes_text(const HuntingPoint& hunting) {
  if (!hunting.failure.empty()) return "not known: " + hunting.failure;
  if (!hunting.from)
    return fmt::format("not found: pushes of {} to {} V died out up to {:.3g} times the gain", least_push,
                       largest_push, hunting.tried);
  return fmt::format("from {:.3g} times the gain on ({}), {} with {:.2g} V at the drive", *hunting.from,
                     hunting.hunts_now() ? "it hunts as it stands" : "below, pushes die out",
                     hertz_text(hunting.frequency), hunting.amplitude);
}

std::string hunting_text(const LoopResult& result) {
  return fmt::format("{}; with {} the margins above hold for this amplitude only",
                     result.hunting ? pushes_text(*result.hunting) : "not known", result.play);
}

/// What the loop is judged by: name and value in words; `why_not`: what follows "not known".
std::vector<renders::ReportRow> margin_rows(const LoopResult& result, const std::string& why_not) {
  const auto& margins = result.margins;
  const auto phase_text = [&] {
    return fmt::format("{:.1f} deg at the crossover of {}", margins.phase->value,
                       hertz_text(margins.phase->frequency));
  };
  if (!loop_doubts(result).empty()) {
    if (!result.known_phase()) return {{{"margins", "not known" + why_not}}};
    const auto of_sine = fmt::format(", with a sine of {:.3g} V", result.plan.amplitude);
    std::vector<renders::ReportRow> known = {{{"phase margin", phase_text() + of_sine}}};
    if (const auto gain = result.known_gain())
      known.push_back({{"gain margin", fmt::format("{:.2f} dB at {}{}", gain->value,
                                                   hertz_text(gain->frequency), of_sine)}});
    known.push_back({{"other margins", "not known" + why_not}});
    return known;
  }
  const std::string absent = "not between these frequencies";
  const auto factor = [](const AtFrequency& margin) { return std::pow(10, margin.value / 20); };
  std::vector<renders::ReportRow> rows;
  const auto row = [&](const char* name, std::string value) { rows.push_back({{name, std::move(value)}}); };
  row("phase margin", margins.phase ? phase_text() : "no crossover between these frequencies");
  row("gain margin", margins.gain ? fmt::format("{:.2f} dB at {}: unstable from {:.3g} times the gain on",
                                                margins.gain->value, hertz_text(margins.gain->frequency),
                                                factor(*margins.gain))
                                  : absent);
  if (!result.play.empty()) row("hunting", hunting_text(result));
  if (margins.gain_down)
    row("gain margin downwards",
        fmt::format("{:.2f} dB at {}: unstable below {:.3g} times the gain", margins.gain_down->value,
                    hertz_text(margins.gain_down->frequency), factor(*margins.gain_down)));
  if (margins.sensitivity)
    row("largest sensitivity",
        fmt::format("{:.2f} at {}", margins.sensitivity->value, hertz_text(margins.sensitivity->frequency)));
  if (const auto& without = result.without_computing) {
    if (without->phase)
      row("phase margin, compute_time 0",
          fmt::format("{:.1f} deg at {}", without->phase->value, hertz_text(without->phase->frequency)));
    if (without->gain)
      row("gain margin, compute_time 0",
          fmt::format("{:.2f} dB at {}", without->gain->value, hertz_text(without->gain->frequency)));
  }
  row("position loop -3 dB", margins.closed_bandwidth ? hertz_text(*margins.closed_bandwidth) : absent);
  if (!result.speed.empty())
    row("speed loop -3 dB", margins.speed_bandwidth ? hertz_text(*margins.speed_bandwidth) : absent);
  return rows;
}

std::string table_text(const LoopResult& result) {
  const auto points = heard(result);
  const auto table = table_of(result, points);
  const bool speed = !result.speed.empty();
  std::string text = fmt::format("{:>10}{:>20}{:>20}{:>20}{:>9}\n{:>10}{:>20}{:>20}{:>20}{:>9}\n",
                                 "frequency", "open loop", "closed loop", speed ? result.speed : "", "error",
                                 "Hz", "dB    deg", "dB    deg", speed ? "dB    deg" : "", "%");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto pair = [&](const BodeColumns& columns) {
      // Of the speed only the change counts: it begins at 0 dB.
      const double zero = &columns == &table.speed ? columns.gain.front() : 0;
      return fmt::format("{:>12.2f}{:>8.1f}", columns.gain[i] - zero, columns.phase[i]);
    };
    text += fmt::format("{:>10.4g}{}{}{:>20}{:>9.2f}\n", points[i].frequency, pair(table.open),
                        pair(table.closed), speed ? pair(table.speed) : "", points[i].error * 100);
  }
  return text;
}

renders::ReportTable response_table(const LoopResult& result) {
  const auto points = known(result);
  const auto table = table_of(result, points);
  renders::ReportTable made{"Response", {"frequency [Hz]"}, {}, true};
  std::vector<const BodeColumns*> all = {&table.open, &table.closed, &table.sensitivity};
  std::vector<std::string> names = {"open loop", "position loop", "sensitivity"};
  if (!result.speed.empty()) {
    all.push_back(&table.speed);
    names.push_back(fmt::format("{}, of its first value", result.speed));
  }
  for (const auto& name : names) {
    made.headings.push_back(name + " [dB]");
    made.headings.push_back(name + " [deg]");
  }
  made.headings.emplace_back("error of the open loop [%]");
  for (std::size_t i = 0; i < points.size(); ++i) {
    renders::ReportRow row{{fmt::format("{:.4g}", points[i].frequency)}};
    for (const auto* columns : all) {
      const double zero = columns == &table.speed ? columns->gain.front() : 0;
      row.cells.push_back(fmt::format("{:.2f}", columns->gain[i] - zero));
      row.cells.push_back(fmt::format("{:.1f}", columns->phase[i]));
    }
    row.cells.push_back(fmt::format("{:.2f}", points[i].error * 100));
    made.rows.push_back(std::move(row));
  }
  return made;
}

/// What was measured, in one line.
std::string subject(const LoopResult& result) {
  const auto& plan = result.plan;
  return fmt::format("{}: {} from {}, sampled every {} ms; a sine of {:.3g} V added from {} s on",
                     result.scenario, result.wire, result.terminal, seconds(plan.sampling) * 1000,
                     plan.amplitude, record::seconds_text(plan.at));
}

/// What the sines say of it.
std::string sines_text(const LimitCycle& cycle) {
  if (!cycle.least) return "no gain margin was found at any amplitude.";
  const auto& least = cycle.margins[*cycle.least];
  auto text = fmt::format("at most {:.3g} times, {} at about {:.2g} V", factor_of(*least.gain),
                          hertz_text(least.gain->frequency), least.amplitude());
  if (const double below = cycle.unknown_below(); below > 0)
    return text + fmt::format("; below {:.2g} V not measured, the bound may be lower.", below);
  return text + (cycle.at_end ? "; this lies at an end of the amplitudes: beyond it may be less."
                              : "; a smaller disturbance may die out.");
}

/// Where a limit cycle begins, in a sentence or two.
std::string verdict_of(const LimitCycle& cycle) {
  const auto sines = "By sines: " + sines_text(cycle);
  return cycle.hunting ? fmt::format("Limit cycle {}. {}", pushes_text(*cycle.hunting), sines)
                       : "Limit cycle. " + sines;
}

renders::ReportTable amplitude_table(const LimitCycle& cycle) {
  renders::ReportTable table{
      "Gain margin over the amplitude of the sine", {"amplitude", "gain margin", "times the gain"}, {}};
  for (const auto& margin : cycle.margins)
    table.rows.push_back({{fmt::format("{:.3g} V", margin.amplitude()),
                           margin.gain ? fmt::format("{:.2f} dB", margin.gain->value) : "no answer",
                           margin.gain ? fmt::format("{:.3g}", factor_of(*margin.gain)) : ""}});
  return table;
}

renders::Plot amplitude_plot(const LimitCycle& cycle) {
  const auto& least = cycle.margins[*cycle.least];
  renders::Plot plot{"limit_cycle",
                     fmt::format("Limit cycle from {:.3g} times the gain on", *cycle.from()),
                     "amplitude of the sine [V]",
                     {}};
  plot.log_x = true;
  renders::Panel panel;
  panel.title = "gain margin";
  panel.y_label = "[dB]";
  renders::Curve curve{"measured", {}, {}, renders::Curve::Style::points};
  for (const auto& margin : cycle.margins) {
    if (!margin.gain) continue;
    curve.x.push_back(margin.amplitude());
    curve.y.push_back(margin.gain->value);
  }
  panel.curves.push_back(std::move(curve));
  plot.marks.push_back({least.amplitude(), "least of the sines"});
  if (cycle.hunting && cycle.hunting->from) {
    const double gain = 20 * std::log10(*cycle.hunting->from);
    panel.bands.push_back({fmt::format("hunts from {:.1f} dB on", gain), gain, gain});
  }
  plot.panels.push_back(std::move(panel));
  return plot;
}

std::string faded_text(const LoopResult& result) {
  return fmt::format("From {} on nothing answers to {:.3g} V: it would be finer than count and DAC resolve.",
                     hertz_text(result.sweep.faded_from), result.plan.amplitude);
}

/// "phase margin >= 30 deg: 65.20 deg at 4.1 Hz".
std::string limits_text(const std::vector<record::CheckResult>& checks) {
  std::string text;
  for (const auto& check : checks)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", check.expectation, check.detail);
  return text;
}

constexpr std::string_view reading =
    "Gains and phases are those of the simulated loop, the delay of sampling and hold included.";

}  // namespace

std::string bode_report(const LoopResult& result) {
  auto text = subject(result) + '\n';
  if (!result.gains.empty()) text += fmt::format("gains in force: {}\n", result.gains);
  // First what is not to be trusted: no number then stands without its reason.
  for (const auto& doubt : loop_doubts(result)) text += to_string(doubt) + '\n';
  if (!heard(result).empty()) {
    text += '\n' + table_text(result) + '\n';
    for (const auto& row : margin_rows(result, ", for the reason above"))
      text += fmt::format("{:<24}{}\n", row.cells[0], row.cells[1]);
    if (result.sweep.faded_from > 0) text += fmt::format("{}\n", faded_text(result));
    text += fmt::format("{}\n", reading);
  }
  return text;
}

std::string limit_cycle_text(const LimitCycle& cycle) {
  const auto table = amplitude_table(cycle);
  std::string text = table.title + "\n";
  for (const auto& row : table.rows)
    text += fmt::format("{:>10}{:>12}{:>14}\n", row.cells[0], row.cells[1], row.cells[2]);
  return text + verdict_of(cycle) + "\n";
}

record::Verdict verdict_of(const LoopResult& result, const std::vector<std::string>& faults,
                           const std::vector<record::CheckResult>& checks) {
  record::Verdict verdict;
  verdict.title = "Frequency response: " + result.wire;
  // Without a limit nothing is judged: who reads PASS would think that it was.
  if (faults.empty() && checks.empty())
    verdict.word = "MEASURED";
  else
    verdict.judge(faults.empty());
  if (!result.sweep.failure.empty()) verdict.stopped();
  verdict.sentence = !faults.empty()  ? fmt::format("{}", fmt::join(faults, "; "))
                     : checks.empty() ? "no limit given, so no verdict"
                                      : limits_text(checks);
  verdict.counts = {{"frequencies", std::ssize(heard(result))},
                    {"limits", std::ssize(checks)},
                    {"faults", std::ssize(faults)}};
  return verdict;
}

void write_bode_report(const LoopResult& result, const LimitCycle* cycle, const record::Verdict& verdict,
                       const std::vector<record::CheckResult>& checks, const std::string& fmi_step,
                       const scenario::Scenario& scenario, OutputFolder& folder) {
  std::vector<renders::Plot> plots;
  auto report = report::page_of(verdict);
  report.scenario = result.file;
  report::add_checks(checks, report);
  report.facts = {
      {{"measured", subject(result)}}, {{"reading", std::string(reading)}}, {{"drycut", DRYCUT_VERSION}}};
  if (!result.gains.empty()) report.facts.push_back({{"gains in force", result.gains}});
  for (std::size_t at = 0; at < fmi_step.size();) {
    const auto end = std::min(fmi_step.find('\n', at), fmi_step.size());
    report.facts.push_back({{"under FMI", fmi_step.substr(at, end - at)}});
    at = end + 1;
  }
  if (const auto lost = heard(result).size() - known(result).size(); lost > 0)
    report.facts.push_back(
        {{"left out", fmt::format("{} where the answer is noise (error above {:.0f} %); bode.csv has "
                                  "them",
                                  counted(static_cast<std::int64_t>(lost), "point"), bode_lost * 100)}});
  if (result.sweep.faded_from > 0) report.facts.push_back({{"ends there", faded_text(result)}});
  if (!known(result).empty()) {
    report.summary = {
        {"Margins",
         {"", ""},
         margin_rows(result, fmt::format(": {}", fmt::join(record::lines_of(loop_doubts(result)), "; ")))}};
    report.tables = {response_table(result)};
    plots.push_back(bode_plot(result, "bode"));
  }
  if (cycle != nullptr) {
    report.facts.insert(report.facts.begin(), {{"limit cycle", verdict_of(*cycle)}});
    report.summary.insert(report.summary.begin(), amplitude_table(*cycle));
    if (cycle->least) plots.push_back(amplitude_plot(*cycle));
  }
  report::add_overrides(scenario.overrides, report);
  report.scenario_expanded = scenario::expand(scenario);
  report::write_report(std::move(report), std::move(plots), folder);
}

std::string bode_csv(const LoopResult& result) {
  const auto points = heard(result);
  const auto table = table_of(result, points);
  const bool speed = !result.speed.empty();
  std::string text(bode_csv_header);
  if (speed) text += fmt::format(",{0}.gain [{1}/V],{0}.phase [deg]", result.speed, result.speed_unit);
  text += '\n';
  for (std::size_t i = 0; i < points.size(); ++i) {
    text +=
        fmt::format("{},{},{},{},{},{},{}", points[i].frequency, table.open.gain[i], table.open.phase[i],
                    table.closed.gain[i], table.closed.phase[i], table.sensitivity.gain[i], points[i].error);
    if (speed) text += fmt::format(",{},{}", std::abs(*points[i].speed), table.speed.phase[i]);
    text += '\n';
  }
  return text;
}

renders::Plot empty_bode_plot(const std::string& name, const std::string& title) {
  renders::Plot plot;
  plot.name = name;
  plot.title = title;
  plot.x_label = "frequency [Hz]";
  plot.log_x = true;
  plot.panel_height = 340;
  renders::Panel gain;
  gain.title = "gain";
  gain.y_label = "[dB]";
  gain.bands = {{"0 dB", 0, 0}};
  renders::Panel phase;
  phase.title = "phase";
  phase.y_label = "[deg]";
  phase.bands = {{"-180 deg", -180, -180}};
  plot.panels = {std::move(gain), std::move(phase)};
  return plot;
}

renders::Plot bode_plot(const LoopResult& result, const std::string& name) {
  const auto table = table_of(result, known(result));
  auto plot = empty_bode_plot(name, fmt::format("{}: {}", result.scenario, result.wire));
  auto& gain = plot.panels[0];
  auto& phase = plot.panels[1];
  // A gap where nothing answered, or where the answer is lost in what else moves.
  const auto draw = [&](const std::string& label, const BodeColumns& columns, double zero) {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    renders::Curve gains{label, {}, {}};
    renders::Curve phases{label, {}, {}};
    std::size_t next = 0;
    for (const auto& point : result.sweep.points) {
      if (next == columns.gain.size()) break;
      const bool is_known = !point.silent && point.error <= bode_lost;
      gains.x.push_back(point.frequency);
      phases.x.push_back(point.frequency);
      gains.y.push_back(is_known ? columns.gain[next] - zero : nothing);
      phases.y.push_back(is_known ? columns.phase[next] : nothing);
      if (is_known) ++next;
    }
    gain.curves.push_back(std::move(gains));
    phase.curves.push_back(std::move(phases));
  };
  draw("open loop", table.open, 0);
  draw("position loop", table.closed, 0);
  if (!table.speed.gain.empty()) draw("speed loop", table.speed, table.speed.gain.front());
  const auto margins = loop_doubts(result).empty() ? result.margins : Margins{};
  if (const auto known = result.known_phase())
    plot.marks.push_back({known->frequency, fmt::format("margin {:.1f}°", known->value)});
  if (margins.gain)
    plot.marks.push_back({margins.gain->frequency, fmt::format("margin {:.1f} dB", margins.gain->value)});
  if (plot.marks.size() == 2 && plot.marks[0].x > plot.marks[1].x) std::swap(plot.marks[0], plot.marks[1]);
  return plot;
}

}  // namespace drycut::sim::studies
