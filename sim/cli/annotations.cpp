#include "sim/cli/annotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "base/json.hpp"
#include "base/plain_text.hpp"
#include "sim/file.hpp"
#include "sim/loop/fingerprint.hpp"
#include "sim/loop/known_events.hpp"

namespace drycut::sim::cli {

namespace {

/// As the runner of GitHub takes it apart: a message ends with its line, a property at a comma or colon too.
std::string escaped(std::string_view text, bool property) {
  std::string escaped;
  for (const char c : text) {
    const bool is_special = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
    escaped += is_special ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return escaped;
}

std::string_view name_of(Annotation::Kind kind) {
  switch (kind) {
    case Annotation::Kind::problem:
      return "drycut-input";
    case Annotation::Kind::check:
      return "drycut-check";
    case Annotation::Kind::run:
      return "drycut-run";
    case Annotation::Kind::warning:
      return "drycut-warning";
  }
  return "";
}

std::string_view severity_of(Annotation::Kind kind) {
  if (kind == Annotation::Kind::warning) return "minor";
  return kind == Annotation::Kind::check ? "major" : "critical";
}

}  // namespace

std::vector<Annotation> annotations_of(const Problems& problems) {
  std::vector<Annotation> all;
  all.reserve(problems.size());
  for (const auto& problem : problems) {
    const std::string text =
        problem.remedy.empty() ? std::string(problem.what) : problem.what + "; " + problem.remedy;
    all.push_back(
        {Annotation::Kind::problem,
         {report::path_from_here(problem.file), std::max(problem.line, 1), std::max(problem.column, 1)},
         "drycut: bad input",
         printable(text),
         problem.what});
  }
  return all;
}

std::vector<Annotation> annotations_of(const std::vector<report::RunResult>& results) {
  std::vector<Annotation> all;
  const auto add = [&](Annotation::Kind kind, report::FilePlace place, const std::string& title,
                       const std::string& message) {
    place.file = report::path_from_here(place.file);
    all.push_back({kind, std::move(place), printable(title), printable(message), title});
  };
  for (const auto& result : results) {
    const auto& checks = result.outcome.checks;
    for (std::size_t i = 0; i < checks.size(); ++i) {
      if (checks[i].passed) continue;
      const auto margin = report::margin_text(checks[i]);
      add(Annotation::Kind::check, result.place_of(i), fmt::format("{}: {}", result.name, checks[i].name),
          fmt::format("{}{}{} ({}){}{}", checks[i].detail, result.outcome.cause().empty() ? "" : ", ",
                      result.outcome.cause(), checks[i].expectation, margin.empty() ? "" : "; ", margin));
    }
    for (const auto& warning : result.outcome.warnings())
      add(Annotation::Kind::warning, result.place_of(checks.size()), result.name + ": warning",
          to_string(warning));
    if (!result.outcome.failure.empty())
      add(Annotation::Kind::run, result.place_of(checks.size()), result.name + ": did not run to its end",
          result.outcome.failure);
    if (result.outcome.passed()) continue;
    for (const auto& alarm : result.outcome.alarms) {
      add(Annotation::Kind::warning, result.place_of(checks.size()),
          fmt::format("{}: alarm of {}", result.name, alarm.source), record::text_of(alarm));
      all.back().lasting += ": " + alarm.text;
    }
  }
  return all;
}

std::string github_text(const std::vector<Annotation>& annotations) {
  std::string text;
  for (const auto& [kind, place, title, message, lasting] : annotations)
    text += fmt::format("::{} file={},line={},col={},title={}::{}\n",
                        kind == Annotation::Kind::warning ? "warning" : "error", escaped(place.file, true),
                        place.line, place.column, escaped(title, true), escaped(message, false));
  return text;
}

std::string gitlab_text(const std::vector<Annotation>& annotations) {
  auto json = Json::array();
  std::map<std::uint64_t, int> twins;
  for (const auto& [kind, place, title, message, lasting] : annotations) {
    loop::Fingerprint own;
    for (const auto part : {name_of(kind), std::string_view(place.file), std::string_view(lasting)})
      own.add(part);
    auto numbered = own;
    numbered.add(std::to_string(twins[own.value()]++));
    json.push_back({{"description", fmt::format("{}: {}", title, message)},
                    {"check_name", name_of(kind)},
                    {"fingerprint", fmt::format("{:016x}", numbered.value())},
                    {"severity", severity_of(kind)},
                    {"location", {{"path", place.file}, {"lines", {{"begin", place.line}}}}}});
  }
  return json_text(json, 2) + "\n";
}

void check_annotate(const std::string& whom, Problems& problems) {
  if (whom != "gitlab") return;
  if (const auto why = hindrance(gitlab_file); !why.empty())
    problems.push_back({"file.not-writable"_code, "--annotate", 1, 1,
                        fmt::format("{} cannot be written: {}", gitlab_file, why),
                        "call drycut in a folder that can be written"});
}

void annotate(const std::string& whom, const std::vector<Annotation>& annotations) {
  if (whom == "github") fmt::print("{}", github_text(annotations));
  if (whom == "gitlab" && hindrance(gitlab_file).empty()) write_file(gitlab_file, gitlab_text(annotations));
}

}  // namespace drycut::sim::cli
