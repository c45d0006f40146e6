#include "sim/cli/summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "renders/html.hpp"

namespace drycut::sim::cli {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_pictures = 6;  ///< of a scene

/// Nothing of it is Markdown, HTML, or the end of a cell.
std::string plain(const std::string& text) {
  std::string plain;
  for (const char c : printable(text)) {
    if (std::string_view("\\`*_{}[]<>#|~&").find(c) != std::string_view::npos) plain += '\\';
    plain += c == '\n' ? ' ' : c;
  }
  return plain;
}

std::string verdict(const report::RunResult& result) {
  if (!result.ran) return "not run";
  if (!result.outcome.failure.empty()) return "stopped";
  if (!result.outcome.passed()) return "**FAILED**";
  const auto warnings = static_cast<std::int64_t>(result.outcome.warnings().size());
  return warnings == 0 ? "passed" : "passed, " + counted(warnings, "warning");
}

class SummaryText {
 public:
  explicit SummaryText(const Summary& summary) : summary_(summary) {}

  std::string of(const std::vector<report::RunResult>& results) {
    const auto good = static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(), [](const auto& r) { return r.outcome.passed(); }));
    text_ = good == results.size()
                ? fmt::format("{}{} passed\n\n", summary_header,
                              good == 1 ? "the one scene" : fmt::format("all {} scenes", good))
                : fmt::format("{}{} of {} scenes failed\n\n", summary_header, results.size() - good,
                              results.size());
    text_ += "| scene | verdict | checks | simulated |\n|---|---|---|---|\n";
    for (const auto& result : results) row(result);
    warnings(results);
    for (const auto& result : results) failures(result);
    if (summary_.links)
      for (const auto& result : results) pictures(result);
    return text_;
  }

 private:
  [[nodiscard]] std::string link(const fs::path& file) const {
    return *summary_.links + renders::link_address(file.lexically_relative(summary_.out).generic_string());
  }

  void row(const report::RunResult& result) {
    const auto& checks = result.outcome.checks;
    const auto passed =
        std::count_if(checks.begin(), checks.end(), [](const auto& c) { return c.passed && !c.so_far; });
    auto name = plain(result.name);
    if (summary_.links && result.has_report)
      name = fmt::format("[{}]({})", name, link(result.directory / "report.html"));
    text_ += fmt::format("| {} | {} | {} of {} | {} s |\n", name, verdict(result), passed, checks.size(),
                         record::seconds_text(result.outcome.end));
  }

  void warnings(const std::vector<report::RunResult>& results) {
    std::string lines;
    for (const auto& result : results)
      for (const auto& warning : result.outcome.warnings())
        lines += fmt::format("- {}: {}\n", plain(result.name), plain(to_string(warning)));
    if (!lines.empty()) text_ += "\nWarnings:\n\n" + lines;
  }

  void failures(const report::RunResult& result) {
    if (result.outcome.passed()) return;
    text_ += fmt::format("\n### {}\n\n", plain(result.name));
    const auto& failure = result.outcome.failure;
    if (!failure.empty())
      text_ += fmt::format("{}{}\n\n", !result.ran ? "" : "The simulation stopped: ", plain(failure));
    const auto& checks = result.outcome.checks;
    if (std::all_of(checks.begin(), checks.end(), [](const auto& c) { return c.passed; })) return;
    if (!result.outcome.cause().empty())
      text_ += fmt::format("It failed {}.\n\n", plain(result.outcome.cause()));
    text_ += "| failed check | expected | measured | beyond the limit | line |\n|---|---|---|---|---|\n";
    for (std::size_t i = 0; i < checks.size(); ++i) {
      if (checks[i].passed) continue;
      const auto place = result.place_of(i);
      text_ +=
          fmt::format("| {} | {} | {} | {} | {}:{} |\n", plain(checks[i].name), plain(checks[i].expectation),
                      plain(checks[i].detail), plain(report::margin_text(checks[i])),
                      plain(report::path_from_here(place.file)), place.line);
    }
  }

  void pictures(const report::RunResult& result) {
    std::vector<fs::path> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(result.directory / "plots", ignored))
      if (entry.path().extension() == ".png") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    const auto all = found.size();
    if (found.empty()) return;
    found.resize(std::min(all, most_pictures));
    text_ += fmt::format("\n<details><summary>{}: pictures</summary>\n\n", xml_text(printable(result.name)));
    for (const auto& file : found)
      text_ += fmt::format("![{}]({})\n", plain(file.stem().string()), link(file));
    if (all > found.size()) text_ += fmt::format("\n{} more in plots/\n", all - found.size());
    text_ += "\n</details>\n";
  }

  const Summary& summary_;
  std::string text_;
};

}  // namespace

std::string summary_text(const std::vector<report::RunResult>& results, const Summary& summary) {
  return SummaryText(summary).of(results);
}

std::string summary_text(const Problems& problems) {
  auto text = fmt::format("{}nothing was run, {} {} wrong\n\n", summary_header,
                          problems.size() == 1 ? "a thing" : fmt::format("{} things", problems.size()),
                          problems.size() == 1 ? "is" : "are");
  for (const auto& problem : problems) text += fmt::format("- {}\n", plain(to_string(problem)));
  return text;
}

std::optional<std::string> links_from(const fs::path& file, const fs::path& out, const std::string& given) {
  if (!given.empty()) return given.ends_with('/') ? given : given + '/';
  std::error_code ignored;
  const auto folder = fs::absolute(file, ignored).lexically_normal().parent_path();
  const auto results = (fs::absolute(out, ignored) / "").lexically_normal().parent_path();
  const auto way = results.lexically_relative(folder);
  if (way == ".") return "";
  if (way.empty() || *way.begin() == "..") return {};
  return renders::link_address(way.generic_string()) + '/';
}

}  // namespace drycut::sim::cli
