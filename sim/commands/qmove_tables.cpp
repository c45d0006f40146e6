// `drycut devices` for the QMOVE's language.
#include <fmt/format.h>

#include <string>

#include "devices/qmove/language.hpp"
#include "sim/commands/controller_table.hpp"
#include "sim/commands/text_table.hpp"

namespace drycut::sim {

namespace {

constexpr std::string_view summary = "QEM QMOVE: the language QCL of its tasks and their schedule";

void print() {
  fmt::print("QMOVE: {}\n", summary);
  TextTable rows({"form", "meaning", "reading of ours, where the manuals leave it open"});
  for (const auto& row : devices::qmove::language)
    rows.add({std::string(row.form), std::string(row.meaning), std::string(row.reading)});
  rows.print("QCL");
}

nlohmann::ordered_json json() {
  nlohmann::ordered_json json = {{"name", "QMOVE"}, {"summary", summary}};
  for (const auto& row : devices::qmove::language) {
    json["language"].push_back({{"form", row.form}, {"meaning", row.meaning}});
    if (!row.reading.empty()) json["language"].back()["reading"] = row.reading;
  }
  return json;
}

}  // namespace

std::vector<ControllerTable> qmove_tables() { return {{"QMOVE", summary, print, json}}; }

}  // namespace drycut::sim
