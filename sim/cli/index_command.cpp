#include "sim/cli/index_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "base/output_file.hpp"
#include "sim/cli/verb.hpp"
#include "sim/output_folder.hpp"
#include "sim/report/index.hpp"

namespace drycut::sim::cli {

namespace fs = std::filesystem;

int index_folder(const fs::path& folder) {
  Problems problems;
  std::error_code ignored;
  const auto refuse = [&](Code code, const char* what, const char* remedy) {
    problems.push_back({code, folder.string(), 1, 1, what, remedy});
  };
  if (!fs::is_directory(folder, ignored))
    refuse("record.no-run"_code,
           fs::exists(folder, ignored) ? "it is not a folder" : "there is no such folder",
           "name one that drycut wrote results into, such as out");
  else if (report::index_entries(folder).empty())
    refuse("record.no-run"_code, "there are no results in it",
           "name a folder of runs, such as out, after drycut run --out out");
  std::optional<OutputFolder> out;
  if (problems.empty())
    out.emplace(folder, report::index_kind, std::vector<std::string>{report::index_file}, problems);
  for (auto& problem : problems) problem.file = folder.string();  // there is no --out
  if (!problems.empty()) {
    print_problems(problems);
    return bad_input;
  }
  try {
    out->begin({report::index_neighbour});
    const auto entries = report::write_index(folder, *out);
    fmt::print("{} {} of results, {}: {}\n", entries.size(), entries.size() == 1 ? "folder" : "folders",
               report::index_verdict(entries), (folder / report::index_file).string());
  } catch (const std::exception& error) {
    return print_failure(drycut::words_of(error));
  }
  return all_passed;
}

namespace {

void index_options(CLI::App& index, int& status) {
  const auto folder = std::make_shared<fs::path>();

  index.add_option("folder", *folder, "Folder of results, such as out")->required();
  index.callback([folder, &status] { status = index_folder(*folder); });
}

}  // namespace

Verb index_verb() {
  return {"index",
          "A page over all results in a folder: index.html, with pictures, verdicts "
          "and links, sortable. drycut run\n"
          "writes it too, into its --out.\n"
          "Exit status: 0 written, 2 bad input, 3 it could not be written",
          {"drycut index out"},
          {},
          index_options};
}

}  // namespace drycut::sim::cli
