#include "sim/studies/sweep/band.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "sim/studies/sweep/answer.hpp"
#include "sim/studies/sweep/page.hpp"

namespace drycut::sim::studies {

namespace {

bool is_limit(const SweepAxis& axis) { return !axis.fit.empty(); }

/// The axes that are limits, or those that are not.
SweepAxes axes_of(const Envelope& envelope, bool limits) {
  SweepAxes axes;
  for (const auto& axis : envelope.axes)
    if (is_limit(axis) == limits) axes.push_back(axis);
  return axes;
}

SweepPoint point_of(const Envelope& envelope, std::size_t point, bool limits) {
  SweepPoint values;
  for (std::size_t i = 0; i < envelope.axes.size(); ++i)
    if (is_limit(envelope.axes[i]) == limits) values.push_back(envelope.points[point][i]);
  return values;
}

void take(const Envelope& envelope, std::size_t point, BoundBand& band) {
  const auto value = [&](std::size_t i) { return envelope.bounds[i].value; };
  band.corners.push_back(point);
  if (envelope.bounds[point].kind == Bound::Kind::nowhere) {
    ++band.nowhere;
    return;
  }
  if (!band.lowest || value(point) < value(*band.lowest)) band.lowest = point;
  if (!band.highest || value(point) > value(*band.highest)) band.highest = point;
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

/// "plants.axis.mass 36.997 kg, plants.axis.carriage_friction.coulomb 120 N"
std::string values_text(const SweepAxes& axes, const SweepPoint& point) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < axes.size(); ++i)
    words.push_back(fmt::format("{} {}", axes[i].parameter.path,
                                with_unit(short_text(number_in(point[i])), axes[i].parameter.unit)));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Of the fit, or fits.
std::string fits_text(const Envelope& envelope) {
  std::vector<std::string> files;
  for (const auto& axis : envelope.axes)
    if (is_limit(axis) && std::ranges::find(files, axis.fit) == files.end()) files.push_back(axis.fit);
  return fmt::format("{}", fmt::join(files, ", "));
}

std::string band_text(const Envelope& envelope, const BoundBand& band) {
  if (!band.lowest) return "none";
  const auto& unit = envelope.request.parameter.unit;
  const auto from = bound_text(envelope.request, envelope.bounds[*band.lowest]);
  const auto to = bound_text(envelope.request, envelope.bounds[*band.highest]);
  const auto text = with_unit(from == to ? from : fmt::format("{} to {}", from, to), unit);
  if (band.nowhere == 0) return text;
  return fmt::format("none at {} of {} corners, else {}", band.nowhere, band.corners.size(), text);
}

}  // namespace

std::vector<BoundBand> bands_of(const Envelope& envelope) {
  std::vector<BoundBand> bands;
  if (std::ranges::none_of(envelope.axes, is_limit)) return bands;
  for (std::size_t i = 0; i < envelope.points.size(); ++i) {
    auto at = point_of(envelope, i, false);
    auto band = std::ranges::find(bands, at, &BoundBand::at);
    if (band == bands.end()) band = bands.insert(bands.end(), BoundBand{std::move(at), {}});
    take(envelope, i, *band);
  }
  return bands;
}

std::string band_answer(const Envelope& envelope, const BoundBand& band) {
  const auto axes = axes_of(envelope, false);
  std::vector<std::string> at;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double number = number_in(band.at[i]);
    at.push_back(with_unit(std::isfinite(number) ? short_text(number) : band.at[i], axes[i].parameter.unit));
  }
  const auto where = at.empty() ? "" : fmt::format("{}: ", fmt::join(at, ", "));
  return where + band_text(envelope, band);
}

std::string corners_text(const Envelope& envelope) {
  const auto bands = bands_of(envelope);
  if (bands.empty()) return "";
  const auto corners = counted(bands.front().corners.size(), "corner");
  if (bands.size() == 1) return fmt::format(" at the {} of the limits of {}", corners, fits_text(envelope));
  double widest = 0;
  for (const auto& band : bands)
    if (band.lowest)
      widest = std::max(widest, envelope.bounds[*band.highest].value - envelope.bounds[*band.lowest].value);
  return fmt::format(" over {}, each at the {} of the limits of {}, which move it by up to {}",
                     counted(bands.size(), "point"), corners, fits_text(envelope),
                     with_unit(fmt::format("{:.3g}", widest), envelope.request.parameter.unit));
}

renders::ReportTable band_table(const Envelope& envelope) {
  const auto& unit = envelope.request.parameter.unit;
  const auto end_heading = [&](const std::string& end) {
    return unit.empty() ? end : fmt::format("{} [{}]", end, unit);
  };
  const auto limits = axes_of(envelope, true);
  renders::ReportTable table{
      fmt::format("{}, at the corners of the limits of {}", sought_text(envelope), fits_text(envelope)),
      page_headings(Table(named_columns(envelope.question, axes_of(envelope, false)))),
      {}};
  table.headings.emplace_back(end_heading("lowest"));
  table.headings.emplace_back(end_heading("highest"));
  table.headings.emplace_back("the lowest is at");
  table.headings.emplace_back("corners where nothing holds");
  for (const auto& band : bands_of(envelope)) {
    auto cells = short_point(band.at);
    const auto end = [&](const std::optional<std::size_t>& point) {
      return point ? bound_text(envelope.request, envelope.bounds[*point]) : "none";
    };
    cells.push_back(end(band.lowest));
    cells.push_back(end(band.highest));
    cells.push_back(band.lowest ? values_text(limits, point_of(envelope, *band.lowest, true)) : "");
    cells.push_back(fmt::format("{} of {}", band.nowhere, band.corners.size()));
    table.rows.push_back({std::move(cells)});
  }
  return table;
}

renders::Plot band_plot(const Envelope& envelope, const std::string& name) {
  const auto others = named_columns(envelope.question, axes_of(envelope, false));
  renders::Plot plot{name,
                     sought_text(envelope) + ", and what the limits of the fit leave open",
                     others.empty() ? "" : others.front().heading(),
                     {}};
  renders::Curve low{"lowest of the corners", {}, {}};
  renders::Curve high{"highest of the corners", {}, {}};
  for (const auto& band : bands_of(envelope)) {
    if (others.size() != 1 || !std::isfinite(number_in(band.at.front())) || !band.lowest) continue;
    low.x.push_back(number_in(band.at.front()));
    low.y.push_back(envelope.bounds[*band.lowest].value);
    high.x.push_back(low.x.back());
    high.y.push_back(envelope.bounds[*band.highest].value);
  }
  if (low.x.size() > 1)
    plot.panels.push_back(panel_of(named_column(envelope.question, envelope.request.parameter), {low, high}));
  return plot;
}

std::string_view band_note(const std::vector<Envelope>& envelopes) {
  const auto has_band = [](const Envelope& one) { return std::ranges::any_of(one.axes, is_limit); };
  if (std::ranges::none_of(envelopes, has_band)) return "";
  return "a corner has every value of the fit at one of its limits of 95 %, all at once: rarer than one of "
         "them alone, so that the band is rather wide. Where the bound does not rise or fall with a value "
         "all "
         "the way it may lie beyond the band: --over PATH=LO..HI UNIT:N looks between the limits";
}

}  // namespace drycut::sim::studies
