#include "sim/studies/sweep/answer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "sim/studies/recorded_csv.hpp"
#include "sim/studies/sweep/band.hpp"

namespace drycut::sim::studies {

namespace {

std::string with_unit(const std::string& number, const TunedParameter& parameter) {
  return parameter.unit.empty() ? number : number + " " + parameter.unit;
}

/// Of the unit's decimal that the tolerance warrants, away from what fails: not above a largest value, not
/// below a smallest.
std::string safe_text(double value, const BoundRequest& request, bool upwards) {
  constexpr double hair = 1e-9;
  const double step = warranted_step(request.tolerance);
  const double steps = value / step;
  return number_text((upwards ? std::ceil(steps - hair) : std::floor(steps + hair)) * step);
}

/// The end of the range that is reached where nothing fails.
std::string far_end(const BoundRequest& request) {
  const auto& parameter = request.parameter;
  return with_unit(fmt::format("{:.6g}", request.least ? parameter.low : parameter.high), parameter);
}

std::string nowhere_text(const Bound& bound) {
  return bound.beyond.verdict == PointRow::Verdict::refused ? "refused everywhere: " + bound.beyond.limit
                                                            : "fails everywhere: " + limit_of(bound.beyond);
}

std::string of_points(const std::string& name, std::size_t count, std::size_t of) {
  return of == 1 ? name : fmt::format("{} ({} of {} points)", name, count, of);
}

}  // namespace

std::string bound_text(const BoundRequest& request, const Bound& bound) {
  if (bound.kind == Bound::Kind::nowhere) return "none";
  const auto text = safe_text(bound.value, request, request.least);
  // Where it holds in less than a step of these digits.
  const double shown = std::stod(text);
  const bool inside = request.least ? shown <= bound.from : shown >= bound.from;
  return inside ? text : number_text(bound.value);
}

std::string sought_text(const Envelope& envelope) {
  return fmt::format("{} {}", envelope.request.least ? "Smallest" : "Largest",
                     with_check_names(envelope.question, envelope.request.parameter.path));
}

std::string elsewhere_text(const BoundRequest& request, const Bound& bound) {
  if (bound.kind == Bound::Kind::nowhere) return "";
  std::string text;
  const auto& parameter = request.parameter;
  if (bound.from != (request.least ? parameter.high : parameter.low))
    text += fmt::format("; holds {} {}, not {}", request.least ? "up to" : "from",
                        with_unit(safe_text(bound.from, request, !request.least), parameter),
                        request.least ? "above" : "below");
  if (bound.again)
    text += fmt::format("; holds again at {}", with_unit(fmt::format("{:.6g}", *bound.again), parameter));
  return text;
}

std::string point_answer(const Envelope& envelope, std::size_t point) {
  const auto& request = envelope.request;
  const auto& bound = envelope.bounds[point];
  std::vector<std::string> at;
  for (std::size_t i = 0; i < envelope.axes.size(); ++i) {
    const auto& value = envelope.points[point][i];
    const auto number = number_of(value);
    at.push_back(with_unit(number ? fmt::format("{:.6g}", *number) : value, envelope.axes[i].parameter));
  }
  auto text = at.empty() ? "" : fmt::format("{}: ", fmt::join(at, ", "));
  if (bound.kind == Bound::Kind::nowhere) return text + nowhere_text(bound);
  text += bound.kind == Bound::Kind::throughout
              ? "holds throughout to " + far_end(request)
              : fmt::format("{}, then {}", with_unit(bound_text(request, bound), request.parameter),
                            limit_of(bound.beyond));
  return text + elsewhere_text(request, bound);
}

std::string span_text(const Envelope& envelope) {
  const Bound* least = nullptr;
  const Bound* most = nullptr;
  for (const auto& bound : envelope.bounds) {
    if (bound.kind == Bound::Kind::nowhere) continue;
    if (least == nullptr || bound.value < least->value) least = &bound;
    if (most == nullptr || bound.value > most->value) most = &bound;
  }
  if (least == nullptr) return "none";
  const auto from = bound_text(envelope.request, *least);
  const auto to = bound_text(envelope.request, *most);
  return with_unit(from == to ? from : fmt::format("{} to {}", from, to), envelope.request.parameter);
}

std::string headline(const Envelope& envelope) {
  const auto& request = envelope.request;
  const auto points = envelope.bounds.size();
  const auto count = [&](Bound::Kind kind) {
    return static_cast<std::size_t>(std::count_if(envelope.bounds.begin(), envelope.bounds.end(),
                                                  [&](const Bound& bound) { return bound.kind == kind; }));
  };
  const auto found = count(Bound::Kind::found);
  const auto throughout = count(Bound::Kind::throughout);
  const auto nowhere = count(Bound::Kind::nowhere);
  auto text = fmt::format("{}: {}", sought_text(envelope), span_text(envelope));
  if (const auto corners = corners_text(envelope); !corners.empty())
    text += corners;
  else if (points > 1)
    text += " over " + counted(points, "point");
  if (found > 0)
    text += fmt::format(" (± {}, rounded {})",
                        with_unit(fmt::format("{:.6g}", request.tolerance), request.parameter),
                        request.least ? "up" : "down");
  std::vector<std::pair<std::string, std::size_t>> limits;  // in the order of their first point
  for (const auto& bound : envelope.bounds) {
    if (bound.kind != Bound::Kind::found) continue;
    const auto name = points > 1 ? region_of(bound.beyond) : limit_of(bound.beyond);
    const auto known =
        std::find_if(limits.begin(), limits.end(), [&](const auto& one) { return one.first == name; });
    if (known == limits.end())
      limits.emplace_back(name, 1);
    else
      ++known->second;
  }
  std::vector<std::string> words;
  words.reserve(limits.size());
  for (const auto& [name, many] : limits) words.push_back(of_points(name, many, points));
  if (!words.empty())
    text += fmt::format("; {} it fails: {}", request.least ? "below" : "above", fmt::join(words, ", "));
  if (throughout > 0) text += "; " + of_points("holds throughout to " + far_end(request), throughout, points);
  if (nowhere > 0)
    text += "; " + (points > 1 ? of_points("fails everywhere", nowhere, points)
                               : nowhere_text(envelope.bounds.front()));
  if (points == 1) text += elsewhere_text(request, envelope.bounds.front());
  return text;
}

std::vector<PointRow::Verdict> verdicts_of(const Envelope& envelope) {
  std::vector<PointRow::Verdict> verdicts;
  for (const auto& bound : envelope.bounds)
    for (const auto& look : bound.looks) verdicts.push_back(look.verdict);
  return verdicts;
}

}  // namespace drycut::sim::studies
