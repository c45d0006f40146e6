#include "sim/cli/help.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "base/embedded.hpp"
#include "base/problem.hpp"
#include "base/text.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/file_kinds.hpp"
#include "sim/cli/pages.hpp"

namespace drycut::sim::cli {

namespace {

constexpr std::size_t page_width = 80;
constexpr std::size_t column = 26;  ///< where meanings begin

/// `text` in lines of the page's width, each after the first behind `indent` blanks; `at`: the first begins
/// there.
std::string wrapped(std::string_view text, std::size_t indent, std::size_t at) {
  std::string lines;
  while (!text.empty()) {
    const auto blank = text.find_first_of(" \n");
    const auto word = text.substr(0, blank);
    if (at > indent && at + 1 + word.size() > page_width) {
      lines += '\n' + std::string(indent, ' ');
      at = indent;
    } else if (at > indent) {
      lines += ' ';
      ++at;
    }
    lines += word;
    at += word.size();
    text.remove_prefix(blank == std::string_view::npos ? text.size() : blank + 1);
  }
  return lines;
}

std::string row(const std::string& name, std::string_view meaning) {
  auto text = "  " + name;
  if (text.size() + 2 > column)
    text += '\n' + std::string(column, ' ');
  else
    text.resize(column, ' ');
  return text + wrapped(meaning, column, column) + '\n';
}

std::string heading_of(std::string_view page) {
  const auto line = page.substr(0, page.find('\n'));
  return std::string(line.substr(std::min(line.size(), line.find_first_not_of("# "))));
}

/// Pages of docs/, by name without ".md".
std::vector<std::string> topics() {
  std::vector<std::string> names;
  constexpr std::string_view ending = ".md";
  for (const auto name : embedded_names())
    if (name.ends_with(ending) && name.find('/') == std::string_view::npos)
      names.emplace_back(name.substr(0, name.size() - ending.size()));
  return names;
}

std::vector<const CLI::App*> listed_commands(const CLI::App& program) {
  const auto all =
      program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
  return {all.begin(), all.end()};
}

/// What it does, without the rest.
std::string beginning_of(const std::string& description) {
  auto end = description.find('\n');
  for (const auto* mark : {": ", ". ", "; "}) end = std::min(end, description.find(mark));
  return description.substr(0, end);
}

std::string program_page(const CLI::App& program) {
  auto text = program.get_description() + "\n\ndrycut COMMAND [options]\n\n";
  for (const auto* command : listed_commands(program)) {
    text += row(command->get_name(), beginning_of(command->get_description()));
  }
  text += "\n";
  for (const auto* option : program.get_options()) text += row(spelling(*option), option->get_description());
  return text;
}

std::string command_page(const CLI::App& command) {
  auto text = wrapped(synopsis(command), 4, 0) + "\n\n";
  const auto description = command.get_description();
  for (const auto line : split_lines(description)) text += wrapped(line, 0, 0) + "\n";
  text += "\n";
  for (const bool positional : {true, false})
    for (const auto* option : command.get_options())
      if (option->get_positional() == positional)
        text += row(spelling(*option), option->get_description() + default_of(*option));
  return text;
}

std::string page_of(const CLI::App& app) {
  const bool is_program = app.get_parent() == nullptr;
  auto text = is_program ? program_page(app) : command_page(app);
  if (const auto examples = examples_of(is_program ? "" : app.get_name()); !examples.empty()) {
    text += "\nExamples:\n";
    for (std::size_t i = 0; i < examples.size(); ++i) {
      const bool goes_on = i + 1 < examples.size() && examples[i + 1].starts_with(' ');
      text += fmt::format("  {}{}\n", examples[i], goes_on ? " \\" : "");
    }
  }
  if (app.get_description().find("Exit status") == std::string::npos) {
    text += "\nExit status:\n";
    for (const auto& [status, meaning] : exit_statuses()) text += row(std::string(status), meaning);
  }
  if (is_program) text += "\ndrycut COMMAND --help says more of a command, drycut help of everything else.\n";
  return text;
}

int tell_topics() {
  fmt::print("drycut help TOPIC prints a page. There are:\n\n");
  for (const auto& name : topics()) fmt::print("{}", row(name, heading_of(embedded_file(name + ".md"))));
  fmt::print(
      "\nThe name of a command gives what its --help says, of a device or plant what drycut devices and\n"
      "drycut plants say; a code such as scenario.unknown-key, which ends the line of a problem or finding,\n"
      "gives its cause and cure.\n");
  return all_passed;
}

int tell_topic(const CLI::App& program, const std::string& topic) {
  const auto names = topics();
  bool told = false;
  std::vector<std::string> known = names;
  const auto is_there = [&topic](const std::vector<Page>& pages) {
    return std::ranges::any_of(pages, [&](const Page& page) { return same_word(page.name, topic); });
  };
  for (const auto* command : listed_commands(program)) {
    known.push_back(command->get_name());
    if (command->get_name() != topic) continue;
    fmt::print("{}", page_of(*command));
    told = true;
  }
  const auto page =
      std::ranges::find_if(names, [&](const std::string& name) { return same_word(name, topic); });
  if (page != names.end()) {
    fmt::print("{}{}", told ? "\n" : "", embedded_file(*page + ".md"));
    told = true;
  }
  if (told) return all_passed;
  if (const auto* found = CodeTable::find(lower(topic))) {
    fmt::print("{}\n  {}.\nCause:\n  {}\nCure:\n  {}\n", found->code, wrapped(found->text, 2, 2),
               wrapped(found->cause, 2, 2), wrapped(found->cure, 2, 2));
    return all_passed;
  }
  if (is_there(device_pages())) return list_devices(topic, false);
  if (is_there(plant_pages())) return list_plants(topic, false);
  if (topic.find('.') != std::string::npos) {
    known.clear();
    for (const auto& row : code_rows) known.emplace_back(row.code);
  }
  fmt::print(stderr, "drycut help: there is no page '{}'; {} [option.unknown-choice]\n", topic,
             did_you_mean(topic, known, "drycut help lists them, docs/reference/codes.md the codes"));
  return bad_input;
}

}  // namespace

std::string spelling(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true);
  const auto type = option.get_type_name();  // "INT:INT in [1 - 256]": what it takes is the latter
  return option.get_name(false, true) +
         (option.get_expected_max() > 0 ? " " + type.substr(type.find(':') + 1) : "");
}

std::string synopsis(const CLI::App& command) {
  auto text = "drycut " + command.get_name();
  for (const auto* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const auto name = option->get_name(true) + (option->get_expected_max() > 1 ? "..." : "");
    text += option->get_required() ? ' ' + name : fmt::format(" [{}]", name);
  }
  return text + " [options]";
}

std::string default_of(const CLI::Option& option) {
  const auto value = option.get_default_str();
  return value.empty() ? "" : fmt::format(" (default: {})", value);
}

std::vector<std::string_view> examples_of(std::string_view command) {
  struct Example {
    std::string_view command;
    std::string_view line;
  };
  static const std::vector<Example> all = {
      {"", "drycut new my_line --from rotary_knife --controller plcopen"},
      {"", "drycut check scenes/rotary_knife.yaml"},
      {"", "drycut run scenes/rotary_knife.yaml"},
      {"run", "drycut run scenes/rotary_knife.yaml"},
      {"run", "drycut run scenes/*.yaml --jobs 2 --out results"},
      {"run", "drycut run my_line.yaml --set variables.length=\"1 m\" --no-pictures"},
      {"run", "drycut run scenes/*.yaml --cache .drycut-cache --annotate github"},
      {"run", "  --summary out/summary.md"},
      {"live", "drycut live scenes/rotary_knife_mc_emergency.yaml"},
      {"live", "drycut live my_line.yaml --record out/today --pace 0.1"},
      {"live", "drycut live --from out/today/1@12.5s"},
      {"replay", "drycut replay out/today/1"},
      {"replay", "drycut replay out/today/1 --to-scenario today.yaml"},
      {"check", "drycut check my_line.yaml"},
      {"cam", "drycut cam scenes/cams/rotary_knife.csv"},
      {"design", R"(drycut design rotary_knife --length "800 mm" --circumference "600 mm")"},
      {"tune", "drycut tune scenes/rotary_knife.yaml --minimise \"rms(AxisX.follerr)\""},
      {"tune", "  --vary controller.qmove.set.AxisX.pgain=1..400 --jobs 2"},
      {"sweep", "drycut sweep scenes/rotary_knife_mc_camin.yaml"},
      {"sweep", "  --over \"plants.web.speed=20..120 m/min:11\" --jobs 2"},
      {"envelope", "drycut envelope scenes/envelope/rotary_knife_camming4.yaml"},
      {"envelope", "  --over \"variables.length=500..1400 mm:10\""},
      {"envelope", "  --find-max \"variables.speed=20..200 m/min:1\""},
      {"bode", "drycut bode scenes/rotary_knife.yaml"},
      {"compare", "drycut compare out/before out/after"},
      {"compare", "drycut compare goldens/rotary_knife out/rotary_knife --tolerance length=0.01mm"},
      {"index", "drycut index out"},
      {"convert", "drycut convert out/rotary_knife --to hdf5"},
      {"new", "drycut new --list"},
      {"new", "drycut new my_line --from rotary_knife --controller plcopen"},
      {"devices", "drycut devices EPICPOS"},
      {"plants", "drycut plants rotary_knife"},
  };
  std::vector<std::string_view> lines;
  for (const auto& example : all)
    if (example.command == command) lines.push_back(example.line);
  return lines;
}

const std::vector<StatusText>& exit_statuses() {
  static const std::vector<StatusText> all = {
      {"0", "all passed"},
      {"1", "a check failed"},
      {"2", "bad input: a line a problem on standard error; nothing was written"},
      {"3", "the simulation failed, or a result could not be written"},
      {"130", "interrupted; what was recorded until then is kept"},
  };
  return all;
}

std::string HelpPage::make_help(const CLI::App* app, std::string /*name*/,
                                CLI::AppFormatMode /*mode*/) const {
  return page_of(*app);
}

void add_commands(CLI::App& app, int& status) {
  app.formatter(std::make_shared<HelpPage>());
  app.require_subcommand(1);  // and what follows is no command more: drycut help run
  for (const auto add :
       {add_run,     add_live,     add_replay, add_check, add_cam,       add_design, add_tune,
        add_sweep,   add_envelope, add_size,   add_bode,  add_compare,   add_index,  add_convert,
        add_devices, add_plants,   add_new,    add_help,  add_reference, add_work})
    add(app, status);
  refuse_wrong_kinds(app);
}

void add_help(CLI::App& program, int& status) {
  auto* command =
      program.add_subcommand("help", "Say more of a command, or print a page of the documentation");
  auto topic = std::make_shared<std::string>();
  command->add_option("topic", *topic, "A command, or a page; without one: what there is");
  command->callback(
      [&program, &status, topic] { status = topic->empty() ? tell_topics() : tell_topic(program, *topic); });
}

}  // namespace drycut::sim::cli
