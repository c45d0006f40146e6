// A comparing scene written back, every default in force.
#include <fmt/format.h>

#include <sstream>

#include "sim/compare/scene.hpp"
#include "sim/scenario/format.hpp"

namespace drycut::sim {

namespace {

/// The plot as a scenario's expansion writes it, with the window about an event in place of its own.
std::string plot_text(const OverlayRequest& request) {
  Scenario view;
  view.pictures.plots.push_back(request.plot);
  const auto whole = expand(view);
  std::istringstream lines(whole.substr(whole.find("    - name: ")));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    const bool window = line.starts_with("      from: ") || line.starts_with("      against: ");
    if (request.around && window) continue;
    text += line + "\n";
    if (!request.around || !line.starts_with("      title: ")) continue;
    const auto& around = *request.around;
    text += fmt::format("      around: {}\n      before: {}\n      after: {}\n",
                        yaml_quoted(fmt::format("{}[{}]", around.event.text, around.number)),
                        format_time(around.before), format_time(around.after));
  }
  return text;
}

std::string member_text(const ComparisonScene::Member& member) {
  auto text = fmt::format("    - name: {}\n      scenario: {}\n", yaml_text(member.name.text),
                          yaml_text(member.scenario.text));
  if (!member.set.empty()) text += "      set:\n";
  for (const auto& [override, place] : member.set)
    text += fmt::format("        {}: {}\n", yaml_text(override.path), yaml_text(override.value));
  if (!member.channels.empty()) text += "      channels:\n";
  for (const auto& channel : member.channels)
    text += fmt::format("        {}: {{of: {}, unit: {}}}\n", yaml_text(channel.name.text),
                        yaml_quoted(channel.of.text), yaml_text(channel.unit));
  return text;
}

}  // namespace

std::string expand(const ComparisonScene& scene) {
  auto text = fmt::format("scene:\n  title: {}\ncompare:\n  scenarios:\n", yaml_text(scene.title));
  for (const auto& member : scene.members) text += member_text(member);
  if (scene.from) text += fmt::format("  from: {}\n", format_time(*scene.from));
  text += scene.figures.empty() ? "  figures: []\n" : "  figures:\n";
  for (const auto& figure : scene.figures)
    text += fmt::format("    - {{name: {}, title: {}, of: {}, unit: {}}}\n", yaml_text(figure.name.text),
                        yaml_text(figure.title), yaml_quoted(figure.of.text), yaml_text(figure.unit));
  text += scene.plots.empty() ? "  plots: []\n" : "  plots:\n";
  for (const auto& request : scene.plots) text += plot_text(request);
  text += scene.checks.empty() ? "checks: []\n" : "checks:\n";
  for (const auto& check : scene.checks)
    text += fmt::format("  - {{name: {}, expect: {}}}\n", yaml_text(check.name.text),
                        yaml_quoted(check.expect.text));
  return text;
}

}  // namespace drycut::sim
