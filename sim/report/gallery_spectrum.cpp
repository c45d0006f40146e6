// What comes back regularly in the values of an event, and what of the machine it may be.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/report/gallery_plots.hpp"
#include "sim/report/spectrum.hpp"

namespace drycut::sim::report {

namespace {

constexpr double metre = 1e3;  // [mm]

/// The spectrum of one value of an event, with what the machine has that turns.
struct ValueSpectrum {
  std::string event;
  std::string value;
  std::string unit;
  std::size_t count = 0;  ///< values looked at
  bool over_web = true;   ///< else over the events
  double length = 0;      ///< of a piece, where all are of one order and the value is that; else 0 [m]
  std::vector<std::string> names;
  std::vector<double> known;  ///< their frequencies
  Spectrum spectrum;
};

double mean(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double number : numbers) sum += number;
  return numbers.empty() ? 0 : sum / static_cast<double>(numbers.size());
}

ValueSpectrum analysed(const MachineFacts& machine, const record::Recording& recording,
                       const scenario::PlotRequest& request) {
  const auto& panel = request.panels.front();
  ValueSpectrum of;
  of.event = panel.event.text;
  of.value = panel.values.front().text;
  const auto series = event_numbers(recording.events(), of.event, of.value, request);
  of.unit = series.unit;
  auto pieces = event_numbers(recording.events(), of.event, "length", request);
  of.over_web = !pieces.numbers.empty() && pieces.unit == "mm" &&
                pieces.numbers.size() == series.numbers.size() &&
                *std::min_element(pieces.numbers.begin(), pieces.numbers.end()) > 0;
  if (!of.over_web) pieces.numbers.clear();
  for (double& length : pieces.numbers) length /= metre;
  const auto values = sampled(series.numbers, pieces.numbers);
  of.count = values.places.size();
  if (of.count < 2) return of;
  const double spacing = (values.places.back() - values.places.front()) / static_cast<double>(of.count - 1);
  const bool even = values.order_count == 1;
  if (of.over_web && even && of.value == "length") of.length = mean(pieces.numbers);

  double highest = of.over_web ? 1 / spacing : 0.499;  // of every second event
  for (const auto& one : machine.recurrences) {
    // What goes by the cuts has a place on the web only while all pieces are alike.
    const bool by_cuts = one.travel == 0;
    if (!of.over_web && !by_cuts) continue;
    if (of.over_web && by_cuts && !even) continue;
    const double frequency = !by_cuts ? 1 / one.travel : 1 / (one.cuts * (of.over_web ? spacing : 1));
    of.names.push_back(one.name);
    of.known.push_back(frequency);
    if (!by_cuts) highest = std::max(highest, 1.2 * frequency);
  }
  of.spectrum = spectrum_of(values, highest, of.known);
  return of;
}

std::string period_text(const ValueSpectrum& of, double frequency) {
  if (of.over_web) return fmt::format("{:.4g} mm", metre / frequency);
  const auto events = fmt::format("{:.4g}", 1 / frequency);
  return fmt::format("{} {}{}", events, of.event, events == "1" ? "" : "s");
}

std::string amplitude_text(const ValueSpectrum& of, double amplitude) {
  return fmt::format("{:.3g}{}{}", amplitude, of.unit.empty() ? "" : " ", of.unit);
}

/// "0.95 mm at 500 mm: once a turn of web.wheel".
std::string short_text(const ValueSpectrum& of, const SpectrumPeak& peak) {
  auto text =
      fmt::format("{} at {}", amplitude_text(of, peak.sine.amplitude), period_text(of, peak.sine.frequency));
  std::vector<std::string> names;
  for (const auto k : peak.known)
    names.push_back(peak.known.size() == 1
                        ? of.names[k]
                        : fmt::format("{} ({})", of.names[k], period_text(of, of.known[k])));
  if (!names.empty()) text += fmt::format(": once a turn of {}", fmt::join(names, " or "));
  return text;
}

/// The same with what it means, and what it could be as well.
std::string peak_text(const ValueSpectrum& of, const SpectrumPeak& peak) {
  const auto& sine = peak.sine;
  std::vector<std::string> others;
  for (const double frequency : peak.others) {
    const double away = std::abs(frequency - sine.frequency);
    if (others.size() < 3 && away > 0.01 * sine.frequency) others.push_back(period_text(of, frequency));
  }
  auto text = short_text(of, peak);
  const double gain = 2 * std::abs(std::sin(std::numbers::pi * sine.frequency * of.length));
  if (peak.known.size() == 1 && of.length > 0 && gain > 0.05)
    text +=
        fmt::format(", as an error of its place by {} makes it", amplitude_text(of, sine.amplitude / gain));
  if (!others.empty())
    text += fmt::format("; pieces of this length show {} alike, others would tell", fmt::join(others, ", "));
  return text;
}

std::string about(const ValueSpectrum& of, std::string (*tell)(const ValueSpectrum&, const SpectrumPeak&)) {
  if (of.count < 10) return fmt::format("{} values are too few", of.count);
  if (of.spectrum.peaks.empty())
    return fmt::format("nothing that chance does not make in {} values", of.count);
  std::vector<std::string> texts;
  for (const auto& peak : of.spectrum.peaks) texts.push_back(tell(of, peak));
  return fmt::format("{}", fmt::join(texts, " | "));
}

}  // namespace

void draw_spectrum(const MachineFacts& machine, const record::Recording& recording,
                   const scenario::PlotRequest& request, renders::Plot& plot) {
  const auto of = analysed(machine, recording, request);
  const auto& panel = request.panels.front();
  renders::Panel shown;
  shown.title = fmt::format("{}{}{}", panel.title, panel.title.empty() ? "" : ": ", about(of, short_text));
  shown.y_label = axis_label("amplitude of " + of.value, {of.unit});
  plot.x_label = of.over_web ? "how often it comes, in a metre of web [1/m]"
                             : fmt::format("how often it comes, in one {} event [-]", of.event);
  plot.panel_height = 420;
  renders::Curve curve;
  curve.style = renders::Curve::Style::area;
  curve.x = of.spectrum.frequencies;
  curve.y = of.spectrum.amplitudes;
  if (!curve.y.empty()) shown.y_range = {0, 1.15 * *std::max_element(curve.y.begin(), curve.y.end())};
  shown.curves.push_back(std::move(curve));
  plot.panels.push_back(std::move(shown));
  for (const auto& peak : of.spectrum.peaks) {
    auto label = period_text(of, peak.sine.frequency);
    for (const auto k : peak.known) label += " " + of.names[k];
    plot.marks.push_back({peak.sine.frequency, std::move(label), true});
    for (const double frequency : peak.others)
      if (std::abs(frequency - peak.sine.frequency) > 0.01 * peak.sine.frequency)
        plot.marks.push_back({frequency, period_text(of, frequency) + " alike"});
  }
  std::stable_sort(plot.marks.begin(), plot.marks.end(),
                   [](const auto& a, const auto& b) { return a.x < b.x; });
}

std::vector<std::string> findings_of(const scenario::Scenario& scenario, const record::Recording& recording,
                                     const MachineFacts& machine) {
  std::vector<std::string> findings;
  for (const auto& request : scenario.pictures.plots) {
    if (!request.panels.front().spectrum) continue;
    const auto of = analysed(machine, recording, request);
    findings.push_back(fmt::format("{} of {}: {}", of.value, of.event, about(of, peak_text)));
  }
  return findings;
}

}  // namespace drycut::sim::report
