#include "sim/studies/sweep/rated_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace drycut::sim::studies {

namespace {

constexpr double no_point = std::numeric_limits<double>::quiet_NaN();

using Operating = std::pair<double, double>;

std::array<Operating, 2 * RatedDrive::speeds> outline_of(const std::vector<Operating>& points) {
  std::array<Operating, 2 * RatedDrive::speeds> outline;
  outline.fill({no_point, no_point});
  if (points.empty()) return outline;
  const auto [slowest, fastest] = std::minmax_element(points.begin(), points.end());
  const double from = slowest->first;
  const double width = fastest->first - from;
  for (const auto& point : points) {
    const double share = width > 0 ? (point.first - from) / width : 0;
    const auto part = std::min(RatedDrive::speeds - 1,
                               static_cast<std::size_t>(share * static_cast<double>(RatedDrive::speeds)));
    auto& high = outline.at(2 * part);
    auto& low = outline.at(2 * part + 1);
    if (std::isnan(high.second) || point.second > high.second) high = point;
    if (std::isnan(low.second) || point.second < low.second) low = point;
  }
  return outline;
}

/// The numbers one after the other, the same way there and back.
template <typename Drive, typename Each>
void visit(Drive& drive, const Each& each) {
  for (auto& figure : drive.figures) {
    each(figure.value);
    each(figure.share);
  }
  each(drive.inertia_ratio);
  each(drive.energy);
  each(drive.trips);
  each(drive.cycles);
  each(drive.steady);
  each(drive.rms.first);
  each(drive.rms.second);
  for (auto& point : drive.outline) {
    each(point.first);
    each(point.second);
  }
}

}  // namespace

std::size_t rating_index(std::string_view name) {
  const auto found =
      std::find_if(ratings.begin(), ratings.end(), [&](const auto& rating) { return rating.name == name; });
  if (found == ratings.end()) throw std::logic_error(fmt::format("'{}' is no rating of a drive", name));
  return static_cast<std::size_t>(found - ratings.begin());
}

std::string failed_rating(const std::vector<record::DriveVerdict>& drives) {
  const record::DriveVerdict* worst = nullptr;
  for (const auto& drive : drives)
    if (!drive.holds() && (worst == nullptr || drive.tightest().share > worst->tightest().share))
      worst = &drive;
  if (worst == nullptr) return "";
  const auto& figure = worst->tightest();
  return (drives.size() > 1 ? worst->drive + " " : "") +
         (worst->trips.empty()
              ? fmt::format("{}: {:.4g} of {:.4g} {}", figure.name, figure.value, figure.rating, figure.unit)
              : worst->trips.front());
}

std::vector<Column> rated_columns(const std::string& drive) {
  std::vector<Column> columns;
  const auto add = [&](const std::string& name, const std::string& unit) {
    columns.push_back({fmt::format("rated.{}", columns.size()), fmt::format("{} {}", drive, name), unit});
  };
  for (const auto& [name, unit, mean] : ratings) {
    add(std::string(name), std::string(unit));
    add(fmt::format("{}, share", name), "");
  }
  add("inertia ratio", "");
  add("energy", "J");
  for (const auto* name : {"trips", "cycles", "steady"}) add(name, "");
  add("mean speed", "rad/s");
  add("rms torque then", "N m");
  for (std::size_t i = 0; i < RatedDrive{}.outline.size(); ++i) {
    add(fmt::format("speed {}", i), "rad/s");
    add(fmt::format("torque {}", i), "N m");
  }
  return columns;
}

std::vector<double> rated_numbers(const record::DriveVerdict& verdict) {
  RatedDrive drive;
  drive.figures.fill({no_point, no_point});
  for (const auto& figure : verdict.figures) {
    if (!figure.judged) continue;
    drive.figures.at(rating_index(figure.name)) = {figure.value, figure.share};
  }
  drive.inertia_ratio = verdict.inertia_ratio;
  drive.energy = verdict.energy;
  drive.trips = static_cast<double>(verdict.trips.size());
  drive.cycles = static_cast<double>(verdict.cycle_points.size());
  drive.steady = verdict.steady ? 1 : 0;
  drive.rms = {no_point, no_point};
  for (const auto& point : verdict.cycle_points)
    if (std::isnan(drive.rms.second) || point.second > drive.rms.second) drive.rms = point;
  drive.outline = outline_of(verdict.points);
  std::vector<double> numbers;
  visit(drive, [&](double number) { numbers.push_back(number); });
  return numbers;
}

RatedDrive rated_drive(const std::vector<double>& row) {
  RatedDrive drive;
  std::size_t count = 0;
  visit(drive, [&](double) { ++count; });
  if (row.size() < count) throw std::logic_error("a row without the ratings of a drive");
  auto next = row.end() - static_cast<std::ptrdiff_t>(count);
  visit(drive, [&](double& number) { number = *next++; });
  return drive;
}

}  // namespace drycut::sim::studies
