#include "base/json.hpp"
#include "sim/studies/tune/parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/record/json.hpp"
#include "sim/studies/fit/study.hpp"

namespace drycut::sim::studies {

namespace {

constexpr int known_format = 1;

bool is_sound(const FittedValue& value) {
  return !value.path.empty() && (!value.value || (value.low && value.high && *value.low < *value.high));
}

std::optional<FitFound> read_fit(const std::string& file, const std::string& option, Problems& problems) {
  const auto text = read_file(file, problems, {option, 1, 1});
  if (!text) return {};
  FitFound found;
  found.format = 0;
  try {
    record::take_json(json_from(*text), found);
    if (found.format == known_format && std::ranges::all_of(found.parameters, is_sound)) return found;
  } catch (const Json::exception&) {  // told below
  }
  problems.push_back({"study.argument"_code, option, 1, 1, fmt::format("{} is no result of a fit", file),
                      "the fit.json of drycut fit, or PATH=LO..HI UNIT"});
  return {};
}

}  // namespace

bool names_fit(std::string_view text) {
  return text.find('=') == std::string_view::npos && trimmed(text).ends_with(".json");
}

std::vector<std::string> given_paths(const std::vector<std::string>& texts) {
  std::vector<std::string> paths;
  for (const auto& text : texts)
    if (const auto equals = text.find('='); equals != std::string::npos)
      paths.emplace_back(trimmed(std::string_view(text).substr(0, equals)));
  return paths;
}

TunedParameters limits_of_fit(const std::string& file, const std::string& option,
                              const std::vector<std::string>& given, Problems& problems) {
  TunedParameters limits;
  const auto found = read_fit(std::string(trimmed(file)), option, problems);
  if (!found) return limits;
  for (const auto& value : found->parameters) {
    if (std::ranges::find(given, value.path) != given.end()) continue;
    if (!value.value) {
      problems.push_back({"fit.not-known"_code, option, 1, 1,
                          fmt::format("{} does not know {}", trimmed(file), value.path),
                          fmt::format("give its range beside it: {}=LO..HI {}", value.path, value.unit)});
      continue;
    }
    TunedParameter limit{value.path, *value.low, *value.high, value.unit};
    limit.option = option;
    limits.push_back(std::move(limit));
  }
  return limits;
}

}  // namespace drycut::sim::studies
