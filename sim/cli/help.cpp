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
#include "sim/cli/verb.hpp"

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
  if (command.empty())
    return {"drycut new my_line --from rotary_knife --controller plcopen",
            "drycut check scenes/rotary_knife.yaml", "drycut run scenes/rotary_knife.yaml"};
  const auto& all = verbs();
  const auto verb = std::ranges::find(all, command, &Verb::name);
  return verb == all.end() ? std::vector<std::string_view>() : verb->examples;
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
  for (const auto& verb : verbs()) {
    auto* command = app.add_subcommand(std::string(verb.name), std::string(verb.help));
    verb.options(*command, status);
    if (verb.shown == Verb::Shown::no) command->group("");
    if (verb.takes.kinds.empty()) continue;
    const auto* files = command->get_option(std::string(verb.takes.option));
    command->parse_complete_callback([&verb, files] { refuse_wrong_kinds(verb.takes, files->results()); });
  }
}

namespace {

void help_options(CLI::App& command, int& status) {
  auto topic = std::make_shared<std::string>();
  command.add_option("topic", *topic, "A command, or a page; without one: what there is");
  command.callback([&command, &status, topic] {
    status = topic->empty() ? tell_topics() : tell_topic(*command.get_parent(), *topic);
  });
}

}  // namespace

Verb help_verb() {
  return {"help", "Say more of a command, or print a page of the documentation", {}, {}, help_options};
}

}  // namespace drycut::sim::cli
