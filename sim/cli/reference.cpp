// `drycut reference`: what the tables of the program say, as files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/problem.hpp"
#include "base/text.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/help.hpp"
#include "sim/cli/pages.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"

namespace drycut::sim::cli {

namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  const auto all =
      program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
  return {all.begin(), all.end()};
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  const auto all = command.get_options();
  return {all.begin(), all.end()};
}

// The manual page.

/// What troff takes for its own.
std::string troff(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else if (c == '\n')
      safe += "\n.br\n";
    else if ((c == '.' || c == '\'') && (safe.empty() || safe.back() == '\n'))
      safe += std::string("\\&") + c;
    else
      safe += c;
  }
  return safe;
}

std::string manual_page(const CLI::App& program) {
  auto page = fmt::format(
      ".TH DRYCUT 1 \"\" \"drycut {}\" \"User Commands\"\n.SH NAME\ndrycut \\- virtual commissioning for "
      "cut\\-to\\-length lines\n.SH SYNOPSIS\n",
      DRYCUT_VERSION);
  for (const auto* command : commands_of(program)) page += troff(synopsis(*command)) + "\n.br\n";
  for (const auto* command : commands_of(program)) {
    page += fmt::format(".SH DRYCUT {}\n{}\n", upper(command->get_name()), troff(command->get_description()));
    for (const auto* option : options_of(*command))
      page += fmt::format(".TP\n.B {}\n{}\n", troff(spelling(*option)),
                          troff(option->get_description() + default_of(*option)));
  }
  page += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : exit_statuses())
    page += fmt::format(".TP\n.B {}\n{}\n", status, troff(meaning));
  page += ".SH EXAMPLES\n.nf\n";
  for (const auto* command : commands_of(program))
    for (const auto line : examples_of(command->get_name())) page += troff(line) + "\n";
  return page + ".fi\n.SH FILES\n.TP\n.I /usr/share/drycut/scenes\nScenarios to begin with.\n";
}

// Completion.

/// A case of the first word: "run) words=...;;"
std::string completion_case(const CLI::App& command) {
  std::string words;
  for (const auto* option : options_of(command))
    for (const auto& name : option->get_lnames()) words += (words.empty() ? "--" : " --") + name;
  return fmt::format("    {}) words=\"{}\" ;;\n", command.get_name(), words);
}

std::string names_of(const std::vector<Page>& pages) {
  std::string names;
  for (const auto& page : pages) names += (names.empty() ? "" : " ") + page.name;
  return names;
}

std::string completion(const CLI::App& program) {
  std::string names;
  std::string cases;
  for (const auto* command : commands_of(program)) {
    names += (names.empty() ? "" : " ") + command->get_name();
    cases += completion_case(*command);
  }
  return fmt::format(
      R"(# Completion of drycut for bash.
_drycut() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" words=""
  case "$COMP_CWORD:${{COMP_WORDS[1]}}" in
    1:*) COMPREPLY=($(compgen -W "{} --help --version" -- "$word")); return ;;
    2:devices) COMPREPLY=($(compgen -W "{} --json --help" -- "$word")); return ;;
    2:plants) COMPREPLY=($(compgen -W "{} --json --motors --motor-template --units --help" -- "$word") $(compgen -f -X '!*.fmu' -- "$word")); return ;;
  esac
  case "${{COMP_WORDS[1]}}" in
{}  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}}
complete -o filenames -F _drycut drycut
)",
      names, names_of(device_pages()), names_of(plant_pages()), cases);
}

// Markdown.

std::string markdown(const Page& page) {
  auto text = fmt::format("# {}\n\n{}\n", page.name, page.summary);
  if (!page.preamble.empty()) text += fmt::format("\n```\n{}\n```\n", page.preamble);
  for (const auto& sheet : page.sheets) text += sheet.markdown();
  return text;
}

std::string contents(const std::string& title, const std::string& made_by, const std::vector<Page>& pages) {
  auto text = fmt::format("# {}\n\nMade by `drycut reference`; `{}` prints the same.\n\n", title, made_by);
  for (const auto& page : pages) text += fmt::format("- [{0}]({0}.md): {1}\n", page.name, page.summary);
  return text;
}

std::string motors() {
  std::string text =
      "# Motors\n\nMade by `drycut reference`; `drycut plants --motors` prints the same, `drycut plants "
      "--motors NAME` every "
      "value of one and where it is from. ~ is an estimate. `values` says how far they can be trusted: "
      "checked, every "
      "value from a sheet was compared with the page that its source names; unchecked, one was not; n "
      "estimated, that "
      "many are not given and the program estimates them on the safe side.\n";
  for (const auto& sheet : motor_tables()) text += sheet.markdown();
  return text;
}

std::string units() {
  std::string text =
      "# Units\n\nMade by `drycut reference`; `drycut plants --units` prints the same. A value is written in "
      "any unit "
      "of its quantity; SI prefixes (`m`, `k`, `u`) and products, quotients and powers (`N m s/rad`) are "
      "understood.\n";
  for (const auto& sheet : unit_tables()) text += sheet.markdown();
  return text;
}

std::string codes() {
  std::string text =
      "# Codes\n\nMade by `drycut reference`; `drycut help CODE` prints the same of one. Every problem, "
      "warning, "
      "note and finding has the code of its kind: in brackets at the end of its line, as `code` in JSON and "
      "in "
      "Python. A sentence may change from release to release; its code does not, and none is used again for "
      "something else.\n";
  std::string_view room;
  Sheet rows("", "", {"code", "what", "cause", "cure"});
  const auto close = [&] {
    if (!room.empty()) text += fmt::format("\n## {}\n{}", room, rows.markdown());
    rows = Sheet("", "", {"code", "what", "cause", "cure"});
  };
  for (const auto& [code, what, cause, cure] : code_rows) {
    const auto own = code.substr(0, code.find('.'));
    if (own != room) close();
    room = own;
    rows.add({fmt::format("`{}`", code), std::string(what), std::string(cause), std::string(cure)});
  }
  close();
  return text;
}

std::string command_line(const CLI::App& program) {
  std::string text = "# Commands\n\nMade by `drycut reference` from the program's own options.\n";
  for (const auto* command : commands_of(program)) {
    text += fmt::format("\n## drycut {}\n\n{}\n\n```\n{}\n```\n", command->get_name(),
                        command->get_description(), synopsis(*command));
    Sheet options("", "", {"option", "meaning"});
    for (const auto* option : options_of(*command))
      options.add({spelling(*option), option->get_description() + default_of(*option)});
    text += options.markdown();
  }
  return text;
}

int write_reference(const CLI::App& program, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto put = [&folder](const std::string& name, const std::string& text) {
    OutputFile file(folder / name);
    file.write(text);
    file.finish();
  };
  put("drycut.1", manual_page(program));
  put("drycut.bash", completion(program));
  put("commands.md", command_line(program));
  put("devices.md", contents("Devices and controllers", "drycut devices NAME", device_pages()));
  put("plants.md", contents("Plants", "drycut plants NAME", plant_pages()));
  put("motors.md", motors());
  put("units.md", units());
  put("codes.md", codes());
  put("cam_tables.md", markdown(cam_table_page()));
  for (const auto& pages : {device_pages(), plant_pages(), scenario_pages()})
    for (const auto& page : pages) put(page.name + ".md", markdown(page));
  return all_passed;
}

}  // namespace

namespace {

void reference_options(CLI::App& reference, int& status) {
  auto folder = std::make_shared<std::filesystem::path>();
  reference.add_option("folder", *folder, "Directory for the files")->required();
  reference.callback(
      [&reference, &status, folder] { status = write_reference(*reference.get_parent(), *folder); });
}

}  // namespace

Verb reference_verb() {
  return {"reference",    "Write the manual page, completion and pages of tables", {}, {}, reference_options,
          Verb::Shown::no};  // for those who build it
}

}  // namespace drycut::sim::cli
