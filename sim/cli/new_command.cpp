#include "sim/cli/new_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/embedded.hpp"
#include "base/plain_text.hpp"
#include "base/problem.hpp"
#include "base/text.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"

namespace drycut::sim::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view folder_of_starts = "new/";
constexpr std::string_view folder_of_projects = "new/project/";
constexpr std::string_view programs_there =
    "../programs/";  ///< as a start names them; beside it in a new line
constexpr std::string_view ending = ".yaml";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

std::string scenario_of(const Start& start) {
  return std::string(
      embedded_file(fmt::format("{}{}_{}{}", folder_of_starts, start.machine, start.controller, ending)));
}

/// The first sentence of the comment that it begins with.
std::string first_sentence(std::string_view text) {
  std::string comment;
  for (const auto line : split_lines(text)) {
    if (!line.starts_with("# ")) break;
    comment += (comment.empty() ? "" : " ") + std::string(line.substr(2));
  }
  return comment.substr(0, comment.find(". ") + 1);
}

/// A file of the new line.
struct NewFile {
  std::string name;
  std::string text;
  std::string about;  ///< "" = README.md does not list it
};

std::string about_file(std::string_view name) {
  const auto kind = fs::path(name).extension();
  if (kind == ".cnf") return "configuration of the controller";
  if (name.starts_with("cams/")) return "cam table of the controller";
  return "program of the controller";
}

/// `--set "variables.length=1 m"`, as its beginning has it.
std::string example_of(std::string_view scenario) {
  constexpr std::string_view option = "--set ";
  const auto begin = scenario.find(option);
  return std::string(scenario.substr(begin, scenario.find('\n', begin) - begin));
}

/// All that the line is made of, README.md last.
std::vector<NewFile> files_of(const Start& start, const std::string& name) {
  const auto scenario = scenario_of(start);
  std::vector<NewFile> files = {{"line.yaml", replaced(scenario, programs_there, "programs/"),
                                 "the scenario: machine, wiring, checks"}};
  for (const auto embedded : embedded_names()) {
    const auto is_program = embedded.starts_with("programs/") &&
                            scenario.find("../" + std::string(embedded)) != std::string::npos;
    const auto inside =
        embedded.starts_with(folder_of_starts) ? embedded.substr(folder_of_starts.size()) : embedded;
    const auto is_cam = inside.starts_with("cams/") && scenario.find(inside) != std::string::npos;
    if (is_program || is_cam)
      files.push_back({std::string(inside), std::string(embedded_file(embedded)), about_file(inside)});
  }
  for (const auto& [from, to] :
       {std::pair{"github.yml", ".github/workflows/drycut.yml"}, std::pair{"gitlab.yml", ".gitlab-ci.yml"},
        std::pair{"gitignore", ".gitignore"}})
    files.push_back({to, std::string(embedded_file(std::string(folder_of_projects) + from)), ""});
  std::string rows;
  for (const auto& file : files)
    if (!file.about.empty())
      rows += fmt::format("{}| `{}` | {} |", rows.empty() ? "" : "\n", file.name, file.about);
  auto readme = std::string(embedded_file(std::string(folder_of_projects) + "README.md"));
  readme = replaced(replaced(readme, "@ABOUT@", start.about), "@FILES@", rows);
  files.push_back(
      {"README.md", replaced(replaced(readme, "@SET@", example_of(scenario)), "@NAME@", name), ""});
  return files;
}

/// "rotary_knife under lx3vp, plcopen, qmove"
std::vector<std::string> controllers_of(const std::string& machine) {
  std::vector<std::string> names;
  for (const auto& start : starts())
    if (start.machine == machine) names.push_back(start.controller);
  return names;
}

std::string all_of_them() {
  std::string text;
  std::string machine;
  for (const auto& start : starts()) {
    if (start.machine != machine) text += fmt::format("{}{} under ", text.empty() ? "" : "; ", start.machine);
    text += (start.machine == machine ? ", " : "") + start.controller;
    machine = start.machine;
  }
  return text;
}

/// What is asked for, if there is such a one.
const Start* chosen_of(const std::vector<Start>& all, const NewOptions& options, Problems& problems) {
  std::vector<std::string> machines;
  for (const auto& start : all)
    if (machines.empty() || machines.back() != start.machine) machines.push_back(start.machine);
  const auto refuse = [&](Code code, const char* option, const std::string& what, const std::string& remedy) {
    problems.push_back({code, option, 1, 1, what, remedy});
    return nullptr;
  };
  if (options.machine.empty())
    return refuse("option.missing"_code, "--from", "no machine is named", "there are: " + all_of_them());
  const auto of_machine = controllers_of(options.machine);
  if (of_machine.empty())
    return refuse("option.unknown-choice"_code, "--from",
                  fmt::format("there is no line of {} to start from", in_quotes(options.machine)),
                  did_you_mean(options.machine, machines, "there are: " + all_of_them()));
  if (options.controller.empty() && of_machine.size() > 1)
    return refuse("option.missing"_code, "--controller", "no controller is named",
                  fmt::format("{} is there under {}", options.machine, listed(of_machine)));
  const auto& controller = options.controller.empty() ? of_machine.front() : options.controller;
  for (const auto& start : all)
    if (start.machine == options.machine && start.controller == controller) return &start;
  return refuse("option.unknown-choice"_code, "--controller",
                fmt::format("there is no {} under {}", options.machine, in_quotes(controller)),
                did_you_mean(controller, of_machine, fmt::format("there are: {}", all_of_them())));
}

void check_folder(const fs::path& folder, Problems& problems) {
  std::error_code error;
  const auto refuse = [&](Code code, const std::string& what, const char* remedy) {
    problems.push_back({code, folder.string(), 1, 1, what, remedy});
  };
  if (folder.empty())
    return refuse("option.missing"_code, "no folder is named",
                  "drycut new FOLDER --from MACHINE --controller CONTROLLER");
  auto above = fs::absolute(folder, error).parent_path();
  while (above.has_relative_path() && !fs::exists(above, error)) above = above.parent_path();
  if (const auto why = hindrance_in(above); !why.empty())
    return refuse("file.not-writable"_code,
                  fmt::format("nothing can be written into {}: {}", above.string(), why),
                  "name a folder elsewhere");
  if (!fs::exists(fs::symlink_status(folder, error))) return;
  if (!fs::is_directory(folder, error))
    return refuse("file.not-ours"_code, "there is a file of that name",
                  "name a folder that is not there yet");
  if (!fs::is_empty(folder, error) || error)
    refuse("file.not-ours"_code, "the folder is not empty", "name one that is empty or not there yet");
}

/// All of them or none: they are written beside the folder, which then takes its name.
void write_all(const std::vector<NewFile>& files, const fs::path& folder) {
  const auto begun = fs::path(folder.string() + ".part");
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(begun, ignored)))
    throw std::runtime_error(fmt::format("{} is in the way", begun.string()));
  try {
    for (const auto& file : files) {
      fs::create_directories((begun / file.name).parent_path());
      write_file(begun / file.name, file.text);
    }
    fs::rename(begun, folder);
  } catch (const std::exception&) {
    fs::remove_all(begun, ignored);
    throw;
  }
}

int list_starts() {
  for (const auto& start : starts())
    fmt::print("{:<16} {:<10} {}\n", start.machine, start.controller, start.about);
  return all_passed;
}

}  // namespace

std::vector<Start> starts() {
  std::vector<Start> all;
  for (const auto name : embedded_names()) {
    if (!name.starts_with(folder_of_starts) || !name.ends_with(ending)) continue;
    const auto stem =
        name.substr(folder_of_starts.size(), name.size() - folder_of_starts.size() - ending.size());
    const auto gap = stem.rfind('_');
    Start start{std::string(stem.substr(0, gap)), std::string(stem.substr(gap + 1)), ""};
    start.about = first_sentence(scenario_of(start));
    all.push_back(std::move(start));
  }
  std::ranges::sort(all, {}, [](const Start& start) { return std::pair(start.machine, start.controller); });
  return all;
}

int make_line(const NewOptions& options) {
  if (options.list) return list_starts();
  Problems problems;
  const auto all = starts();
  const auto folder = (options.folder / "").lexically_normal().parent_path();
  check_folder(options.folder.empty() ? options.folder : folder, problems);
  const auto* start = chosen_of(all, options, problems);
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  const auto files = files_of(*start, folder.filename().string());
  try {
    write_all(files, folder);
  } catch (const std::exception& error) {
    return print_failure("drycut new: " + drycut::words_of(error));
  }
  fmt::print("{}: {}\n", folder.string(), start->about);
  for (const auto& file : files) fmt::print("  {}\n", file.name);
  fmt::print("Run it: {} run {}\n", shell_word(program_invocation_name),
             shell_word((folder / "line.yaml").string()));  // as called
  return all_passed;
}

namespace {

void new_options(CLI::App& command, int& status) {
  const auto chosen = std::make_shared<NewOptions>();
  auto& options = *chosen;
  command.add_option("folder", options.folder, "Folder to make; one that is there must be empty");
  command.add_option("--from", options.machine,
                     "Machine, one of those that --list tells: rotary_knife, flying_saw, vertical_press ...");
  command.add_option("--controller", options.controller, "Controller: qmove, lx3vp, plcopen");
  command.add_flag("--list", options.list, "Tell which machines there are under which controllers");
  command.callback([chosen, &status] { status = make_line(*chosen); });
}

}  // namespace

Verb new_verb() {
  return {"new",
          "Make a folder with a line of one's own that runs at once: scenario, program, cam, files for CI",
          {"drycut new --list", "drycut new my_line --from rotary_knife --controller plcopen"},
          {},
          new_options};
}

}  // namespace drycut::sim::cli
