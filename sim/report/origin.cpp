#include "sim/report/origin.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>

#include "renders/process.hpp"

namespace drycut::sim::report {

namespace {

constexpr std::int64_t last_second = 253'402'300'799;  // of the year 9999

std::optional<std::int64_t> whole(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 0 || number > last_second)
    return {};
  return number;
}

std::string date_text(std::int64_t seconds) {
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

/// What git says, without the line's end; nothing where it has nothing to say or is not there.
std::string git(const std::filesystem::path& folder, std::vector<std::string> words) {
  // It may be somebody's at work: no lock is taken for a look.
  words.insert(words.begin(), {"--no-optional-locks", "-C", folder.string()});
  try {
    auto finished = renders::run_process({"git", "git", std::move(words)});
    if (!finished.good) return "";
    while (finished.output.ends_with('\n')) finished.output.pop_back();
    return finished.output;
  } catch (const std::runtime_error&) {
    return "";
  }
}

struct Repository {
  std::string commit;  ///< "" = there is none
  std::int64_t date = 0;
  bool changed = false;  ///< files that it keeps are not as in the commit
};

Repository repository_at(const std::filesystem::path& folder) {
  const auto commit = git(folder, {"log", "-1", "--format=%h %ct"});
  const auto space = commit.find(' ');
  const auto date = space == std::string::npos ? std::nullopt : whole(commit.substr(space + 1));
  if (!date) return {};
  return {commit.substr(0, space), *date,
          !git(folder, {"status", "--porcelain", "--untracked-files=no"}).empty()};
}

/// Asked once a folder.
Repository known_repository_at(const std::filesystem::path& folder) {
  static std::mutex mutex;
  static std::map<std::filesystem::path, Repository> known;
  const std::scoped_lock lock(mutex);
  const auto found = known.find(folder);
  return found != known.end() ? found->second : known.emplace(folder, repository_at(folder)).first->second;
}

}  // namespace

std::vector<renders::ReportRow> origin_of(const std::filesystem::path& scenario) {
  std::error_code ignored;
  const auto file = std::filesystem::absolute(scenario, ignored);
  const auto folder = file.parent_path();
  auto repository = known_repository_at(folder);
  if (!repository.commit.empty())
    repository.changed =
        repository.changed || git(folder, {"ls-files", "--", file.filename().string()}).empty();

  std::vector<renders::ReportRow> facts;
  const char* given = std::getenv("SOURCE_DATE_EPOCH");
  struct stat status {};
  if (const auto date = whole(given == nullptr ? "" : given)) {
    facts.push_back({{"date", date_text(*date)}});
  } else if (given != nullptr && *given != '\0') {
    facts.push_back({{"date", fmt::format("SOURCE_DATE_EPOCH is {}: not a number of seconds", given)}});
  } else if (!repository.commit.empty() && !repository.changed) {
    facts.push_back({{"date of the commit", date_text(repository.date)}});
  } else if (stat(file.c_str(), &status) == 0) {
    facts.push_back({{"scenario written", date_text(status.st_mtime)}});
  }
  if (!repository.commit.empty())
    facts.push_back({{"commit", repository.commit + (repository.changed ? ", changed since" : "")}});
  return facts;
}

}  // namespace drycut::sim::report
