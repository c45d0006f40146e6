#include "sim/report/index.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/embedded.hpp"
#include "renders/html.hpp"
#include "sim/file.hpp"
#include "sim/report/report.hpp"
#include "sim/report/results.hpp"

namespace drycut::sim::report {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view manifest_prefix = ".drycut-";

/// Who wrote into a folder, by the manifests in it: "run", "compare"; "runs" into one of several.
std::vector<std::string> kinds_of(const fs::path& folder) {
  std::vector<std::string> kinds;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const auto name = entry.path().filename().string();
    if (name.starts_with(manifest_prefix)) kinds.push_back(name.substr(manifest_prefix.size()));
  }
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

/// Files of a folder that end so, by name.
std::vector<fs::path> ending(const char* extension, const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == extension && entry.is_regular_file(ignored))
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// A frame from the middle of the film; of a study its map or first plot.
void add_picture(const fs::path& folder, const fs::path& root, IndexEntry& entry) {
  const auto take = [&](const fs::path& picture, std::string words) {
    entry.picture = picture.lexically_relative(root).generic_string();
    entry.picture_words = std::move(words);
  };
  const auto frames = ending(".png", folder / "frames");
  if (!frames.empty()) return take(frames[frames.size() / 2], "The machine of " + entry.name);
  auto plots = ending(".png", folder / plots_folder);
  if (plots.empty()) plots = ending(".png", folder);  // of a cam that was designed
  if (!plots.empty()) take(plots.front(), fmt::format("{} of {}", plots.front().stem().string(), entry.name));
}

IndexEntry entry_of(const fs::path& folder, const fs::path& root, const std::string& kind) {
  IndexEntry entry;
  entry.name = folder.lexically_relative(root).generic_string();
  entry.kind = kind;
  const auto relative = [&](const char* file) {
    return (folder / file).lexically_relative(root).generic_string();
  };
  std::error_code ignored;
  if (const auto verdict = record::read_verdict(folder);
      verdict && (verdict->kind.empty() || verdict->kind == kind)) {
    entry.came = verdict->verdict;
    entry.word = verdict->headword();
    entry.verdict = verdict->sentence;
    entry.title = verdict->title;
    entry.simulated = verdict->simulated;
    entry.version = verdict->drycut;
  }
  if (fs::is_regular_file(folder / report_file, ignored)) {
    entry.page = relative(report_file);
  } else {
    for (const auto* file : {trace_file, hdf5_file, checks_file})
      if (entry.page.empty() && fs::is_regular_file(folder / file, ignored)) entry.page = relative(file);
    const auto tables = ending(".csv", folder);
    if (entry.page.empty() && !tables.empty()) entry.page = relative(tables.front().filename().c_str());
  }
  if (entry.title.empty()) entry.title = folder.filename().string();
  add_picture(folder, root, entry);
  return entry;
}

/// Folders that nobody here wrote into are not looked through: a folder of results may be a home.
void collect(const fs::path& folder, const fs::path& root, std::vector<IndexEntry>& entries) {
  std::vector<fs::path> folders;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_directory(ignored) && !entry.is_symlink(ignored)) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  for (const auto& one : folders) {
    const auto kinds = kinds_of(one);
    for (const auto& kind : kinds)
      if (kind != index_kind) entries.push_back(entry_of(one, root, kind));
    if (!kinds.empty()) collect(one, root, entries);
  }
}

// ---- the page ----

using Came = record::Verdict::Came;

bool has_failed(const IndexEntry& entry) { return entry.came == Came::failed; }
bool is_judged(const IndexEntry& entry) { return has_failed(entry) || entry.came == Came::passed; }

/// What failed first, then what is not known, what judges nothing, what passed.
int rank_of(const IndexEntry& entry) {
  return has_failed(entry) ? 0 : !entry.came ? 1 : entry.came == Came::none ? 2 : 3;
}

const char* state_of(bool failed, bool judged) { return failed ? "fail" : judged ? "pass" : "told"; }

std::string row_of(const IndexEntry& entry) {
  using renders::html_text;
  using renders::link_address;
  const auto link = [&](const std::string& inner, const char* more) {
    return entry.page.empty() ? inner
                              : fmt::format("<a href=\"{}\"{}>{}</a>", link_address(entry.page), more, inner);
  };
  // The name beside it opens the same page.
  const auto picture =
      entry.picture.empty()
          ? std::string()
          : link(fmt::format("<img loading=\"lazy\" width=\"160\" height=\"90\" alt=\"{}\" src=\"{}\">",
                             html_text(entry.picture_words), link_address(entry.picture)),
                 " tabindex=\"-1\"");
  const auto badge =
      fmt::format("<span class=\"badge {}\">{}</span>", state_of(has_failed(entry), is_judged(entry)),
                  entry.came ? html_text(entry.word) : "?");
  return fmt::format(
      "<tr{}><td class=\"picture\">{}</td><th scope=\"row\" data-sort=\"{}\">{}<small>{}</small></th>"
      "<td data-sort=\"{}\" data-of=\"verdict\">{} {}</td><td data-sort=\"{}\" data-of=\"what\">{}</td>"
      "<td class=\"number\" data-sort=\"{:.9g}\" data-of=\"simulated [s]\">{}</td><td "
      "data-of=\"drycut\">{}</td></tr>\n",
      has_failed(entry) ? " class=\"fail\"" : "", picture, html_text(entry.name),
      link(html_text(entry.name), ""), html_text(entry.title), rank_of(entry), badge,
      html_text(entry.verdict), html_text(entry.kind), html_text(entry.kind), entry.simulated.value_or(-1),
      entry.simulated ? fmt::format("{:.6g}", *entry.simulated) : "", html_text(entry.version));
}

}  // namespace

std::vector<IndexEntry> index_entries(const fs::path& folder) {
  std::vector<IndexEntry> entries;
  collect(folder, folder, entries);
  return entries;
}

std::string index_verdict(const std::vector<IndexEntry>& entries) {
  std::string said;
  std::size_t judged = 0;
  // A comparison that finds a difference is no run that failed.
  const auto count = [&](bool runs, const char* one, const char* several) {
    std::size_t all = 0;
    std::size_t failed = 0;
    for (const auto& entry : entries) {
      if ((entry.kind == "run") != runs || !is_judged(entry)) continue;
      ++all;
      failed += has_failed(entry) ? 1 : 0;
    }
    judged += all;
    if (all == 0) return;
    said += said.empty() ? "" : "; ";
    said += failed > 0 ? fmt::format("{} of {} {} failed", failed, all, all == 1 ? one : several)
            : all == 1 ? fmt::format("the one {} passed", one)
                       : fmt::format("all {} {} passed", all, several);
  };
  count(true, "run", "runs");
  count(false, "comparison or study", "comparisons and studies");
  if (judged == 0) return "nothing is judged";
  if (const auto told = entries.size() - judged; told > 0)
    said += fmt::format("; {} {} nothing", told, told == 1 ? "judges" : "judge");
  return said;
}

std::string index_page(const std::vector<IndexEntry>& entries) {
  const bool failed = std::ranges::any_of(entries, has_failed);
  const bool judged = std::ranges::any_of(entries, is_judged);
  const auto* state = state_of(failed, judged);
  const auto word = failed ? "FAIL" : judged ? "PASS" : "RUNS";
  const auto said = index_verdict(entries);
  std::string rows;
  for (const auto& entry : entries) rows += row_of(entry);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}: runs</title>\n"
      "<style>{1}\n{2}</style>\n</head>\n<body>\n<main>\n<header>\n<h1>Runs</h1>\n<p>{3} {4} of "
      "results</p>\n</header>\n"
      "<p class=\"verdict {5}\"><strong>{0}</strong> <span>{6}</span></p>\n"
      "<div class=\"scroll index\">\n<table class=\"index\">\n<thead><tr><td></td><th scope=\"col\">run</th>"
      "<th scope=\"col\">verdict</th><th scope=\"col\">what</th><th scope=\"col\" class=\"number\">simulated "
      "[s]</th>"
      "<th scope=\"col\">drycut</th></tr></thead>\n<tbody>\n{7}</tbody>\n</table>\n</div>\n</main>\n"
      "<script>{8}</script>\n</body>\n</html>\n",
      word, embedded_file("report.css"), embedded_file("index.css"), entries.size(),
      entries.size() == 1 ? "folder" : "folders", state, said, rows, embedded_file("index.js"));
}

std::vector<IndexEntry> write_index(const fs::path& folder, OutputFolder& out) {
  auto entries = index_entries(folder);
  write_file(out.add(index_file), index_page(entries));
  return entries;
}

}  // namespace drycut::sim::report
