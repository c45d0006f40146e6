#include "sim/figures.hpp"

#include <algorithm>
#include <set>

#include "renders/process.hpp"

namespace drycut::sim {

namespace {

constexpr auto* plots_folder = "plots";

void name_apart(std::vector<renders::Plot>& plots) {
  std::set<std::string> taken;
  for (auto& plot : plots)
    while (!taken.insert(plot.name).second) plot.name += '_';
}

}  // namespace

std::string add_plots(std::vector<renders::Plot>& plots, OutputFolder& folder, renders::Report& report) {
  if (plots.empty()) return "";
  name_apart(plots);
  std::vector<std::string> names;
  for (const auto& plot : plots) names.push_back(plot.name + ".png");
  const auto place = folder.add(plots_folder, names);
  std::string left_out;
  try {
    renders::draw_plots(plots, place);
  } catch (const renders::HelperFailed& failed) {
    left_out = failed.what();
    report.facts.push_back({{"left out", left_out}});
  }
  for (const auto& name : names) {
    const bool drawn = std::filesystem::exists(place / name);
    report.plots.push_back({drawn ? place / name : "", plots_folder + ("/" + name)});
  }
  return left_out;
}

std::string draw_png(renders::Plot plot, const std::filesystem::path& png) {
  plot.name = png.stem().string();
  try {
    renders::draw_plots({plot}, png.has_parent_path() ? png.parent_path() : std::filesystem::path("."));
  } catch (const renders::HelperFailed& failed) {
    return failed.what();
  }
  return "";
}

}  // namespace drycut::sim
