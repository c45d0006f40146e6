#include "sim/cli/pages.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>

#include "base/json.hpp"
#include "base/problem.hpp"
#include "base/text.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/file_kinds.hpp"
#include "sim/cli/verb.hpp"

namespace drycut::sim::cli {

namespace {

Json json_of(const Page& page) {
  Json json = {{"name", page.name}, {"summary", page.summary}};
  for (const auto& sheet : page.sheets)
    if (auto rows = sheet.json(); !sheet.key().empty() && !rows.empty()) json[sheet.key()] = std::move(rows);
  if (!page.aliases.empty()) json["aliases"] = page.aliases;
  return json;
}

void print(const Page& page) {
  fmt::print("{}: {}\n", page.name, page.summary);
  if (!page.preamble.empty()) fmt::print("\n{}\n", page.preamble);
  const auto width = output_width();
  for (const auto& sheet : page.sheets) fmt::print("{}", sheet.text(width));
}

/// Says that there is no page of that name, and which there are.
int unknown(const PageKind& kind, const std::string& name, const std::vector<Page>& pages) {
  std::vector<std::string> names;
  names.reserve(pages.size());
  for (const auto& page : pages) names.push_back(page.name);
  fmt::print(stderr, "{}: there is no {} '{}'; {} [option.unknown-choice]\n", kind.command, kind.what, name,
             did_you_mean(name, names, "there are: " + listed(names)));
  return bad_input;
}

void add_pages(CLI::App& pages, int& status, const std::function<int(const std::string&, bool)>& list,
               const char* about_name) {
  struct Chosen {
    std::string name;
    bool json = false;
  };
  const auto chosen = std::make_shared<Chosen>();
  pages.add_option("name", chosen->name, about_name);
  pages.add_flag("--json", chosen->json, "As JSON");
  pages.callback([chosen, &status, list] { status = list(chosen->name, chosen->json); });
}

void devices_options(CLI::App& devices, int& status) {
  add_pages(devices, status, list_devices, "Device type, such as CAMMING4");
}

void plants_options(CLI::App& plants, int& status) {
  struct Instead {
    bool motors = false;
    bool form = false;
    bool units = false;
  };
  const auto instead = std::make_shared<Instead>();
  const auto list = [instead](const std::string& name, bool json) {
    return instead->motors  ? list_motors(name, json)
           : instead->form  ? print_motor_template(name)
           : instead->units ? list_units(name, json)
                            : list_plants(name, json);
  };
  add_pages(
      plants, status, list,
      "Plant type, such as rotary_knife, or an FMU of others, drive.fmu; with --motors a motor, such as "
      "HG-SR202");
  auto* motors = plants.add_flag(
      "--motors", instead->motors,
      "Motors for servo: {model: ...} and induction_motor: {model: ...}, or the values of one with "
      "their sources; those in ./catalogue too");
  auto* form = plants.add_flag(
      "--motor-template", instead->form,
      "A file for a motor of your own, to fill in with five values of its data sheet and keep "
      "in catalogue/; of induction motors: --motor-template induction_motor");
  auto* units = plants.add_flag(
      "--units", instead->units,
      "The units that scenarios and catalogues understand, or those of one quantity, such as torque");
  motors->excludes(form)->excludes(units);
  form->excludes(units);
}

}  // namespace

Verb devices_verb() {
  return {
      "devices", "List device types, or the table of one", {"drycut devices EPICPOS"}, {}, devices_options};
}

Verb plants_verb() {
  return {"plants",
          "List plant types, or the table of one, or the variables of an FMU that is to be one",
          {"drycut plants rotary_knife", "drycut plants drive.fmu"},
          {},
          plants_options};
}

int show(const PageKind& kind, const std::vector<Page>& pages, const std::string& name, bool json,
         const std::vector<Sheet>& overview) {
  if (!name.empty()) {
    const auto page = std::ranges::find_if(pages, [&](const auto& p) { return same_word(p.name, name); });
    if (page == pages.end()) return unknown(kind, name, pages);
    if (json)
      fmt::print("{}\n", json_text(json_of(*page), 2));
    else
      print(*page);
  } else if (json) {
    auto all = Json::array();
    for (const auto& page : pages) all.push_back(json_of(page));
    fmt::print("{}\n", json_text(all, 2));
  } else if (!overview.empty()) {
    for (const auto& sheet : overview) fmt::print("{}", sheet.text(output_width()));
  } else {
    for (const auto& page : pages)
      if (page.listed) fmt::print("{:<14} {}\n", page.name, page.summary);
  }
  return all_passed;
}

std::vector<Page> device_pages() {
  auto pages = qmove_pages();
  std::ranges::move(plcopen_pages(), std::back_inserter(pages));
  std::ranges::move(lx3vp_pages(), std::back_inserter(pages));
  return pages;
}

int list_devices(const std::string& name, bool json) {
  return show({"drycut devices", "device type"}, device_pages(), name, json);
}

int list_plants(const std::string& name, bool json) {
  if (kind_of(name) == FileKind::fmu) return list_fmu(name, json);
  return show({"drycut plants", "plant type"}, plant_pages(), name, json);
}

}  // namespace drycut::sim::cli
