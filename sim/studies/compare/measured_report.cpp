#include "sim/studies/compare/measured_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/output_file.hpp"
#include "base/text.hpp"
#include "sim/record/verdict.hpp"
#include "sim/report/report.hpp"
#include "sim/studies/compare/overlays.hpp"

namespace drycut::sim::studies {

namespace {

constexpr std::size_t most_points = 4000;  ///< of a curve: a page must stay readable
constexpr double percent = 100;

std::string with_unit(const std::string& name, const std::string& unit) {
  return fmt::format("{}{}[{}]", name, name.empty() ? "" : " ", unit.empty() ? "-" : unit);
}

/// Every so many of a channel's instants, the worst one among them.
std::vector<std::size_t> drawn_instants(const MeasuredChannel& channel) {
  const auto stride = channel.times.size() / most_points + 1;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < channel.times.size(); ++i)
    if (i % stride == 0 || channel.times[i] == channel.worst_at) chosen.push_back(i);
  return chosen;
}

std::vector<double> of_instants(const std::vector<double>& values, const std::vector<std::size_t>& instants) {
  std::vector<double> chosen;
  chosen.reserve(instants.size());
  for (const auto i : instants) chosen.push_back(values[i]);
  return chosen;
}

renders::Plot time_plot(const MeasuredChannel& channel) {
  const auto instants = drawn_instants(channel);
  const auto times = of_instants(channel.times, instants);
  renders::Plot plot;
  plot.name = "measured_" + as_file_name(channel.name);
  plot.title = channel.name + ": measured and simulated";
  plot.x_label = "time in the run [s]";
  plot.panel_height = 240;
  renders::Curve measured{"measured", times, of_instants(channel.measured, instants)};
  measured.faint = true;  // seen on both sides of the simulated one, which lies on it
  plot.panels.push_back(
      {"",
       with_unit(channel.name, channel.unit),
       {std::move(measured), renders::Curve{"simulated", times, of_instants(channel.simulated, instants)}},
       {},
       {}});
  plot.panels.push_back({"Residual: simulated less measured",
                         with_unit("", channel.unit),
                         {renders::Curve{"residual", times, of_instants(channel.residual, instants)}},
                         {{"", 0, 0}},
                         {}});
  return plot;
}

/// The residual over speed or position, a colour a direction.
renders::Plot motion_plot(const MeasuredChannel& channel, const MeasuredChannel::Motion& motion,
                          const std::string& kind) {
  const auto ways = channel.speed ? directions_of(*channel.speed) : std::vector<int>(channel.times.size(), 0);
  renders::Plot plot;
  plot.name = "residual_" + as_file_name(channel.name) + "_over_" + kind;
  plot.title = fmt::format("{}: residual over {}", channel.name, motion.name);
  plot.x_label = with_unit(motion.name, motion.unit);
  renders::Panel panel{"", with_unit("simulated less measured", channel.unit), {}, {{"", 0, 0}}, {}};
  for (const int way : {1, -1, 0}) {
    renders::Curve curve;
    curve.label = way > 0 ? "forwards" : way < 0 ? "backwards" : channel.speed ? "hardly moving" : "residual";
    curve.style = renders::Curve::Style::points;
    curve.faint = way == 0 && channel.speed.has_value();
    for (const auto i : drawn_instants(channel)) {
      if (ways[i] != way) continue;
      curve.x.push_back(motion.values[i]);
      curve.y.push_back(channel.residual[i]);
    }
    if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
  }
  plot.panels.push_back(std::move(panel));
  return plot;
}

std::vector<renders::Plot> residual_plots(const MeasuredRun& measured) {
  std::vector<renders::Plot> plots;
  for (const auto& channel : measured.channels) {
    plots.push_back(time_plot(channel));
    if (channel.speed && channel.speed->name != channel.name)
      plots.push_back(motion_plot(channel, *channel.speed, "speed"));
    if (channel.position && channel.position->name != channel.name)
      plots.push_back(motion_plot(channel, *channel.position, "position"));
  }
  return plots;
}

renders::ReportTable shown_table(const Prose& title, const Table& table) {
  renders::ReportTable page{title, {}, {}};
  for (auto& heading : table.headings()) page.headings.emplace_back(std::move(heading));
  for (std::size_t row = 0; row < table.rows().size(); ++row) page.rows.push_back({table.shown(row)});
  return page;
}

bool is_judged(const MeasuredRun& measured) {
  return std::ranges::any_of(measured.channels, [](const auto& one) { return one.allowed.has_value(); });
}

record::Verdict residual_verdict(const MeasuredRun& measured) {
  record::Verdict verdict;
  verdict.title = fmt::format("{} against {}", measured.file.filename().string(),
                              measured.run.folder.lexically_normal().string());
  const auto beyond =
      std::ranges::count_if(measured.channels, [](const auto& one) { return !one.is_kept(); });
  if (is_judged(measured))
    verdict.judge(beyond == 0);
  else
    verdict.word = "MEASURED";
  verdict.sentence = residual_sentence(measured);
  verdict.found(measured.findings);
  verdict.counts = {{"channels", std::ssize(measured.channels)}, {"channels_beyond", beyond}};
  return verdict;
}

renders::Report residual_page(const MeasuredRun& measured, const Table& hints,
                              const std::vector<std::string>& tolerances) {
  auto page = report::page_of(residual_verdict(measured));
  page.scenario = measured.file.string();
  page.summary.push_back(shown_table("What the run leaves of what was measured: simulated less measured",
                                     residual_table(measured)));
  if (!hints.rows().empty())
    page.summary.push_back(
        shown_table("What one value alone would explain; drycut fit finds values and limits", hints));
  for (const auto& finding : measured.findings) page.notes.push_back(to_string(finding));
  if (!measured.only_measured.empty())
    page.facts.push_back({{"measured only", listed(measured.only_measured)}});
  page.facts.push_back({{"recording", measured.file.string()}});
  page.facts.push_back({{"run", measured.run.folder.string()}});
  for (const auto& tolerance : tolerances) page.facts.push_back({{"--tolerance", tolerance}});
  return page;
}

}  // namespace

Table residual_table(const MeasuredRun& measured) {
  Table table({{"channel", "channel"},
               {"unit", "unit"},
               {"samples", "samples"},
               {"relative", "residual, of measured (rms)", "%", 4},
               {"rms", "residual rms", "", 6},
               {"mean", "mean", "", 6},
               {"worst", "worst", "", 6},
               {"worst_at", "at", "s"},
               {"forwards", "mean forwards", "", 6},
               {"backwards", "mean backwards", "", 6},
               {"allowed", "allowed", "", 6}});
  const auto cell = [](const std::optional<double>& number) {
    return number ? Table::Cell(*number) : Table::Cell(std::string());
  };
  for (const auto& channel : measured.channels)
    table.add({channel.name, channel.unit.empty() ? "-" : channel.unit,
               static_cast<double>(channel.times.size()),
               std::isfinite(channel.relative) ? Table::Cell(channel.relative * percent)
                                               : Table::Cell(std::string()),
               channel.rms, channel.mean, channel.worst, channel.worst_at, cell(channel.mean_forwards),
               cell(channel.mean_backwards), cell(channel.allowed)});
  return table;
}

std::string residual_sentence(const MeasuredRun& measured) {
  const auto told = [](const MeasuredChannel& channel) {
    return fmt::format("{} by {:.4g}{} at {:g} s at most{}", channel.name, channel.worst,
                       channel.unit.empty() ? "" : " " + channel.unit, channel.worst_at,
                       channel.allowed ? fmt::format(", {:.4g} allowed", *channel.allowed) : "");
  };
  const auto beyond = std::ranges::find_if(measured.channels, [](const auto& one) { return !one.is_kept(); });
  if (beyond != measured.channels.end()) return "beyond the tolerance: " + told(*beyond);
  const auto worst = std::ranges::max_element(measured.channels, {}, &MeasuredChannel::relative);
  return fmt::format("{} of {} beside the run; the furthest apart: {}",
                     counted(std::ssize(measured.channels), "channel"), measured.file.filename().string(),
                     told(*worst));
}

int write_measured(const MeasuredRun& measured, const Table& hints,
                   const std::vector<std::string>& tolerances, OutputFolder& folder, bool pictures) {
  write_file(folder.add("comparison.csv"), residual_table(measured).csv());
  if (pictures)
    report::write_report(residual_page(measured, hints, tolerances), residual_plots(measured), folder);
  const auto verdict = residual_verdict(measured);
  record::write_verdict(verdict, folder);
  return verdict.exit;
}

}  // namespace drycut::sim::studies
