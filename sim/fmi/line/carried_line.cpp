#include "sim/fmi/line/carried_line.hpp"

#include "base/json.hpp"
#include "sim/fmi/line/built_line.hpp"
#include "sim/scenario/units.hpp"

namespace drycut::sim::fmi {

std::string line_bytes(const CarriedLine& line) {
  Json files = Json::object();
  for (const auto& [name, file] : line.files)
    files[name] = {static_cast<int>(file.state), Json::binary({file.bytes.begin(), file.bytes.end()})};
  Json set = Json::array();
  for (const auto& [path, value] : line.set) set.push_back({path, value});
  const auto bytes = Json::to_cbor({{"made_by", line.made_by},
                                    {"scenario", line.scenario},
                                    {"set", std::move(set)},
                                    {"files", std::move(files)},
                                    {"folders", line.folders}});
  return {bytes.begin(), bytes.end()};
}

CarriedLine read_line(std::string_view bytes) {
  const auto json = Json::from_cbor(bytes);
  CarriedLine line{json.at("made_by"), json.at("scenario"), {}, {}, {}};
  for (const auto& one : json.at("set")) line.set.push_back({one.at(0), one.at(1)});
  for (const auto& [name, file] : json.at("files").items()) {
    const auto& content = file.at(1).get_binary();
    line.files[name] = {static_cast<FileSet::State>(file.at(0).get<int>()), {content.begin(), content.end()}};
  }
  line.folders = json.at("folders").get<decltype(line.folders)>();
  return line;
}

LineSource::LineSource(CarriedLine line) : line_(std::move(line)) {
  const BuiltLine plain(line_, {});
  step_ = plain.step_length();
  parameters_ = plain.parameters();
}

std::unique_ptr<FmiModel> LineSource::build(const FmiModel::Given& given) const {
  auto changed = std::vector<scenario::Override>();
  FmiModel::Given of_controller;
  for (const auto& [reference, value] : given) {
    const auto parameter = parameters_.find(reference);
    if (parameter == parameters_.end()) {
      of_controller[reference] = value;
      continue;
    }
    const auto& [path, unit, type] = parameter->second;
    if (const auto* word = std::get_if<std::string>(&value))
      changed.push_back({path, *word});
    else if (type == FmiVariable::Type::flag)
      changed.push_back({path, std::get<double>(value) != 0 ? "true" : "false"});
    else
      changed.push_back({path, scenario::format_quantity(std::get<double>(value), unit)});
  }
  auto built = std::make_unique<BuiltLine>(line_, changed);
  built->take(of_controller);
  return built;
}

}  // namespace drycut::sim::fmi
