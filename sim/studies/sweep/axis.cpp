#include "sim/studies/sweep/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <charconv>
#include <cmath>

#include "base/text.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::studies {

namespace {

constexpr std::string_view log_suffix = ":log";
constexpr int most_steps = 1'000'000;

class AxisReader {
 public:
  AxisReader(const std::string& text, const std::string& option, bool sampled, Problems& problems)
      : text_(text), option_(option), sampled_(sampled), problems_(problems) {}

  std::optional<SweepAxis> run() {
    if (text_.find("..") == std::string::npos) return list();
    SweepAxis axis;
    auto rest = text_;
    if (rest.ends_with(log_suffix)) {
      axis.logarithmic = true;
      rest.resize(rest.size() - log_suffix.size());
    }
    const auto colon = rest.rfind(':');
    if (colon != std::string::npos && sampled_) {
      return refuse(
          "study.argument"_code, colon,
          fmt::format("'{}' says how many values a grid has, and a sample has none", rest.substr(colon)),
          "leave it out");
    }
    if (colon != std::string::npos) {
      axis.steps = steps(rest, colon + 1);
      if (!axis.steps) return {};
      rest.resize(colon);
    } else if (!sampled_) {
      return refuse("study.argument"_code, text_.size(),
                    fmt::format("'{}' does not say how many values", text_),
                    "add their number: 20..300 m/min:57");
    }
    auto parameter = parse_parameter(rest, option_, false, problems_);
    if (!parameter) return {};
    if (axis.logarithmic && !(parameter->low > 0))
      return refuse("study.argument"_code, static_cast<std::size_t>(parameter->low_column - 1),
                    "a logarithmic range begins above 0", "or leave :log out");
    axis.parameter = std::move(*parameter);
    return axis;
  }

 private:
  std::nullopt_t refuse(Code code, std::size_t offset, std::string what, std::string remedy) {
    problems_.push_back({code, option_, 1, static_cast<int>(offset) + 1, std::move(what), std::move(remedy)});
    return std::nullopt;
  }

  std::optional<int> steps(const std::string& text, std::size_t from) {
    int number = 0;
    const auto* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + from, end, number);
    const bool too_large = read.ec == std::errc::result_out_of_range || number > most_steps;
    if (read.ptr != end || (read.ec != std::errc() && !too_large))
      return refuse("study.out-of-range"_code, from,
                    fmt::format("'{}' is no number of values", text.substr(from)), "such as :26");
    if (number < 2 || too_large)
      return refuse("study.out-of-range"_code, from,
                    fmt::format("{} values from end to end", text.substr(from)),
                    fmt::format("2 to {}", most_steps));
    return number;
  }

  // PATH=1,2,5 mm: numbers with one unit, or words.
  std::optional<SweepAxis> list() {
    const auto equals = text_.find('=');
    if (equals == std::string::npos || equals == 0)
      return refuse("study.argument"_code, 0, fmt::format("'{}' gives no values to a path", text_),
                    "write PATH=A..B UNIT:N, such as variables.length=500..3000 mm:26");
    SweepAxis axis;
    axis.parameter.option = option_;
    axis.parameter.path = trimmed(std::string_view(text_).substr(0, equals));
    axis.parameter.low_column = axis.parameter.high_column = static_cast<int>(equals) + 2;
    const auto items = items_from(equals + 1);
    for (const auto& [item, at] : items) {
      if (item.empty()) return refuse("study.argument"_code, at, "an empty value", "write PATH=1,2,5 mm");
      if (std::find(axis.values.begin(), axis.values.end(), item) != axis.values.end())
        return refuse("study.twice"_code, at, fmt::format("{} is given twice", item), "keep one");
      axis.values.push_back(item);
    }
    const auto is_number = [](const Item& item) { return quantity_in(item.text).has_value(); };
    const auto word = std::find_if_not(items.begin(), items.end(), is_number);
    if (std::none_of(items.begin(), items.end(), is_number)) {
      for (const auto& item : items) axis.word_columns.push_back(static_cast<int>(item.at) + 1);
      return axis;
    }
    if (word != items.end())
      return refuse("study.argument"_code, word->at,
                    fmt::format("'{}' is no number as the others are", word->text),
                    "numbers with one unit, or words");
    axis.parameter.unit = quantity_in(items.back().text)->unit;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto quantity = *quantity_in(items[i].text);
      const auto& unit = quantity.unit;
      if (!unit.empty() && unit != axis.parameter.unit)
        return refuse("study.wrong-unit"_code, equals + 1,
                      fmt::format("values in {} and {}", unit, axis.parameter.unit),
                      "give all of them in one unit");
      const auto value = number_text(quantity.number);
      const auto same =
          std::find(axis.values.begin(), axis.values.begin() + static_cast<std::ptrdiff_t>(i), value);
      if (same != axis.values.begin() + static_cast<std::ptrdiff_t>(i))
        return refuse("study.twice"_code, items[i].at, fmt::format("{} is given twice", value), "keep one");
      axis.values[i] = value;
    }
    return axis;
  }

  struct Item {
    std::string text;
    std::size_t at;  // in text_
  };
  [[nodiscard]] std::vector<Item> items_from(std::size_t at) const {
    std::vector<Item> items;
    for (;; ++at) {
      const auto comma = std::min(text_.find(',', at), text_.size());
      auto begin = at;
      while (begin < comma && text_[begin] == ' ') ++begin;
      items.push_back({std::string(trimmed(std::string_view(text_).substr(at, comma - at))), begin});
      at = comma;
      if (at == text_.size()) return items;
    }
  }

  /// A number with a unit that there is, or without: 1FK7 is a word.
  static std::optional<scenario::ParsedQuantity> quantity_in(const std::string& text) {
    const auto quantity = scenario::parse_quantity(text);
    const bool known = quantity && std::isfinite(quantity->number) &&
                       (quantity->unit.empty() || scenario::is_unit(quantity->unit));
    return known ? quantity : std::nullopt;
  }

  const std::string& text_;
  const std::string& option_;
  bool sampled_;
  Problems& problems_;
};

double at_share(const SweepAxis& axis, double share) {
  const auto& [low, high] = std::pair(axis.parameter.low, axis.parameter.high);
  if (share == 1) return high;
  return axis.logarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
}

}  // namespace

std::string number_text(double value) { return fmt::format("{:.15g}", value); }

Column column_of(const TunedParameter& parameter) { return {parameter.path, parameter.path, parameter.unit}; }
std::string heading(const TunedParameter& parameter) { return column_of(parameter).heading(); }

std::vector<Column> columns_of(const SweepAxes& axes) {
  std::vector<Column> columns;
  for (const auto& axis : axes) columns.push_back(column_of(axis.parameter));
  return columns;
}

std::optional<SweepAxis> parse_axis(const std::string& text, const std::string& option, bool sampled,
                                    Problems& problems) {
  return AxisReader(text, option, sampled, problems).run();
}

void fill_axis(SweepAxis& axis, Problems& problems) {
  if (!axis.steps) return;
  for (int i = 0; i < *axis.steps; ++i) {
    const double value = at_share(axis, static_cast<double>(i) / (*axis.steps - 1));
    axis.values.push_back(number_text(value));
    if (!axis.parameter.integer || value == std::rint(value)) continue;
    problems.push_back(
        {"study.argument"_code, axis.parameter.option, 1, axis.parameter.low_column,
         fmt::format("{} is a whole number, and {} is none", axis.parameter.path, axis.values.back()),
         "another number of values, or a list: 1,2,5"});
    return;
  }
}

SweepAxes parse_over(const std::string& text, const std::string& option, bool sampled,
                     const std::vector<std::string>& given, Problems& problems) {
  SweepAxes axes;
  if (!names_fit(text)) {
    if (auto axis = parse_axis(text, option, sampled, problems)) axes.push_back(std::move(*axis));
    return axes;
  }
  for (auto& limit : limits_of_fit(text, option, given, problems)) {
    SweepAxis axis{std::move(limit), {}};
    if (!sampled) axis.steps = 2;
    axis.fit = trimmed(text);
    axes.push_back(std::move(axis));
  }
  return axes;
}

SweepAxes parse_axes(const std::vector<std::string>& texts, const std::string& option, bool sampled,
                     Problems& problems) {
  SweepAxes axes;
  const auto given = given_paths(texts);
  for (const auto& text : texts)
    for (auto& axis : parse_over(text, option, sampled, given, problems)) axes.push_back(std::move(axis));
  return axes;
}

std::vector<scenario::Override> overrides_of(const SweepAxes& axes, const SweepPoint& point) {
  std::vector<scenario::Override> overrides;
  overrides.reserve(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto& parameter = axes[i].parameter;
    overrides.push_back(
        {parameter.path, parameter.unit.empty() ? point[i] : fmt::format("{} {}", point[i], parameter.unit)});
  }
  return overrides;
}

std::optional<std::size_t> grid_size(const SweepAxes& axes, std::size_t most) {
  std::size_t size = 1;
  for (const auto& axis : axes) {
    const auto count = axis.steps ? static_cast<std::size_t>(*axis.steps) : axis.values.size();
    if (count > most / size) return {};
    size *= count;
  }
  return size;
}

std::vector<SweepPoint> grid(const SweepAxes& axes) {
  std::vector<SweepPoint> points = {{}};
  for (const auto& axis : axes) {
    std::vector<SweepPoint> longer;
    longer.reserve(points.size() * axis.values.size());
    for (const auto& point : points) {
      for (const auto& value : axis.values) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    }
    points = std::move(longer);
  }
  return points;
}

static_assert(sobol_axes == boost::random::default_sobol_table::max_dimension);

std::vector<std::vector<double>> sobol_shares(std::size_t axes, std::size_t count) {
  // Point 0, where all ranges begin, is left out by Boost.
  std::vector<std::vector<double>> points(count, std::vector<double>(axes));
  if (axes == 0) return points;
  boost::random::sobol_engine<std::uint32_t, 32> numbers(axes);
  constexpr double end = 4294967296.0;
  for (std::size_t number = 1; number < count; ++number)
    for (auto& share : points[number]) share = numbers() / end;
  return points;
}

std::vector<SweepPoint> sobol(const SweepAxes& axes, std::size_t count) {
  std::vector<SweepPoint> points(count);
  const auto shares = sobol_shares(axes.size(), count);
  for (std::size_t number = 0; number < count; ++number) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const auto& axis = axes[i];
      const double share = shares[number][i];
      if (!axis.is_range()) {
        const auto which = static_cast<std::size_t>(share * static_cast<double>(axis.values.size()));
        points[number].push_back(axis.values[which]);
      } else {
        const double value = at_share(axis, share);
        points[number].push_back(number_text(axis.parameter.integer ? std::rint(value) : value));
      }
    }
  }
  return points;
}

}  // namespace drycut::sim::studies
