#include "sim/cli/sweep_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <memory>
#include <optional>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/cli/arguments.hpp"
#include "sim/cli/progress.hpp"
#include "sim/cli/verb.hpp"
#include "sim/file.hpp"
#include "sim/output_folder.hpp"
#include "sim/studies/sweep/answer.hpp"
#include "sim/studies/sweep/band.hpp"
#include "sim/studies/sweep/report.hpp"
#include "sim/studies/sweep/study.hpp"

namespace drycut::sim::cli {

namespace {

constexpr auto* sweep_file = "sweep.csv";
constexpr auto* envelope_file = "envelope.csv";
constexpr auto* points_file = "points.cache";  // goes on where it ended

std::vector<std::string> files_of(const std::string& table) {
  std::vector<std::string> files = {table, points_file};
  files.insert(files.end(), studies::study_pages.begin(), studies::study_pages.end());
  return files;
}

void read_figures(const StudyOptions& options, studies::PointQuestion& question, Problems& problems) {
  for (const auto& text : options.figures) {
    const auto equals = text.find('=');
    const auto name = text.substr(0, equals);
    const bool twice = std::any_of(question.figures.begin(), question.figures.end(),
                                   [&](const auto& figure) { return figure.name == name; });
    if (equals == std::string::npos || equals == 0 || name.find('(') != std::string::npos)
      problems.push_back({"study.argument"_code, "--figure", 1, 1, fmt::format("'{}' is no NAME=TERM", text),
                          "such as peak=max(abs(knife.motor.torque))"});
    else if (twice)
      problems.push_back({"study.twice"_code, "--figure", 1, 1,
                          fmt::format("there are two figures named '{}'", name), "rename one"});
    else
      question.figures.push_back({name, text.substr(equals + 1)});
  }
}

studies::PointQuestion read_question(const StudyOptions& options, const std::filesystem::path& scenario,
                                     Problems& problems) {
  studies::PointQuestion question;
  question.file = scenario;
  question.set = overrides_of(options.set, problems);
  read_figures(options, question, problems);
  auto text = read_file(scenario, problems);
  if (!text) return question;
  question.text = std::move(*text);
  studies::prepare(question, problems);
  return question;
}

/// "sobol:1000"
std::optional<std::size_t> read_sample(const std::string& text, Problems& problems) {
  if (text.empty()) return {};
  constexpr std::string_view kind = "sobol:";
  std::size_t count = 0;
  const auto* const end = text.data() + text.size();
  if (text.starts_with(kind)) {
    const auto read = std::from_chars(text.data() + kind.size(), end, count);
    if (read.ec == std::errc() && read.ptr == end && count > 0 && count <= studies::most_points) return count;
  }
  problems.push_back({"study.argument"_code, "--sample", 1, 1, fmt::format("'{}' is no sample", text),
                      fmt::format("sobol:N, N from 1 to {}", studies::most_points)});
  return {};
}

/// A bar that says how long it will still take.
class Countdown {
 public:
  explicit Countdown(std::string doing) : doing_(std::move(doing)) {}
  void show(std::size_t done, std::size_t of) {
    using namespace std::chrono;
    const double elapsed = duration<double>(steady_clock::now() - begin_).count();
    const double left = elapsed / static_cast<double>(done) * static_cast<double>(of - std::min(of, done));
    const auto text = left < 90 ? fmt::format("{:.0f} s", left) : fmt::format("{:.0f} min", left / 60);
    bar_.show(fmt::format("{}, {} left", doing_, text), static_cast<double>(done) / static_cast<double>(of));
  }
  void clear() { bar_.clear(); }

 private:
  std::string doing_;
  ProgressBar bar_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// How many rows have which limit, the most first, equal ones by name. Why there is no run may differ from
/// row to row: the first one's is told.
void print_limits(const std::vector<studies::PointRow>& rows) {
  using Verdict = studies::PointRow::Verdict;
  std::map<std::string, std::pair<std::size_t, std::string>> counts;
  for (const auto& row : rows) {
    const bool failed = row.verdict == Verdict::failed;
    auto& [count, first] = counts[failed ? "failed: " + region_of(row) : std::string(name_of(row.verdict))];
    if (count++ == 0 && !failed && !row.limit.empty()) first = ", the first: " + row.limit;
  }
  std::vector<std::pair<std::string, std::pair<std::size_t, std::string>>> all(counts.begin(), counts.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.second.first > b.second.first; });
  for (const auto& [name, told] : all)
    fmt::print("{:>8} {}{}\n", told.first, printable(name), printable(told.second));
}

/// What several scenarios have to say alike is told once.
int bad(const Problems& problems) {
  Problems once;
  for (const auto& problem : problems)
    if (std::ranges::find(once, problem) == once.end()) once.push_back(problem);
  print_problems(once);
  return bad_input;
}

/// Runs `work` on the folder's store, which gives the exit status; what it throws is told.
template <typename Work>
int in_folder(const StudyOptions& options, OutputFolder& folder, const Work& work) {
  try {
    Problems problems;
    auto workers = workers_of(options.cluster, options.jobs, options.out, problems);
    if (!problems.empty()) return bad(problems);
    folder.begin_aside({points_file});
    studies::PointStore store(folder.add(points_file), std::move(workers));
    const int status = work(store);
    fmt::print("{} runs simulated now{}\n", store.simulated(),
               store.refused() > 0 ? fmt::format(", {} refused", store.refused()) : "");
    print_left_out(store.lost());
    return status;
  } catch (const std::exception& error) {
    return print_failure(fmt::format("{}: {}", options.out.string(), drycut::words_of(error)));
  }
}

void add_study(CLI::App& command, StudyOptions& options, const char* over_help) {
  command.add_option("--over", options.over, over_help)->allow_extra_args(false);
  command
      .add_option(
          "--figure", options.figures,
          "NAME=TERM, a column more, such as \"peak=max(abs(knife.motor.torque))\"; terms as of tune; "
          "may be repeated")
      ->allow_extra_args(false);
  command.add_option("--jobs", options.jobs, "Runs at the same time; the result is the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  add_on(command, options.cluster);
  add_set(command, options.set, "scenario");
  add_out(command, options.out, "Directory for the results; runs in it are not run again");
}

}  // namespace

int sweep_scenario(const SweepOptions& options) {
  Problems problems;
  const auto sampled = read_sample(options.sample, problems);
  auto axes = studies::parse_axes(options.over, "--over", !options.sample.empty(), problems);
  auto question = read_question(options, options.scenario, problems);
  if (sampled && axes.size() > studies::sobol_axes)
    problems.push_back({"study.out-of-range"_code, "--sample", 1, 1, fmt::format("{} axes", axes.size()),
                        fmt::format("a Sobol sequence is over {} at most", studies::sobol_axes)});
  const auto points = studies::planned(axes, sampled, question, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(options.out, "sweep", files_of(sweep_file), problems);
  if (!problems.empty()) return bad(problems);
  return in_folder(options, *folder, [&](studies::PointStore& store) {
    Countdown bar("sweeping");
    const auto rows = studies::sweep(question, axes, points, store,
                                     [&](std::size_t done, std::size_t of) { bar.show(done, of); });
    bar.clear();
    write_file(folder->add(sweep_file), studies::sweep_table(question, axes, points, rows).csv());
    auto verdict = studies::write_sweep_report(question, axes, points, rows, *folder);
    print_limits(rows);
    std::vector<studies::PointRow::Verdict> verdicts;
    for (const auto& row : rows) verdicts.push_back(row.verdict);
    fmt::print("{}, {}: {}\nreport: {}\n", counted(rows.size(), "point"), studies::counts_of(verdicts),
               (options.out / sweep_file).string(), (options.out / "report.html").string());
    return finish(std::move(verdict), store, *folder);
  });
}

namespace {

/// What stands before "NAME:PATH=..."; "" where no name does.
std::string name_before(const std::string& option) {
  const auto colon = option.find(':');
  return colon < option.find('=') ? option.substr(0, colon) : "";
}

std::string text_behind_name(const std::string& option) {
  const auto name = name_before(option);
  return name.empty() ? option : option.substr(name.size() + 1);
}

/// The options that are for a scenario: those that name it, else those without a name.
std::vector<std::string> options_for(const std::string& scene, const std::vector<std::string>& options) {
  std::vector<std::string> named;
  std::vector<std::string> common;
  for (const auto& option : options) {
    const auto name = name_before(option);
    if (name.empty()) common.push_back(option);
    if (!name.empty() && scene.starts_with(name)) named.push_back(option);
  }
  return named.empty() ? common : named;
}

void refuse_unknown_names(const std::vector<std::string>& options, const char* option,
                          const std::vector<std::string>& scenes, Problems& problems) {
  for (const auto& text : options) {
    const auto name = name_before(text);
    const bool known =
        name.empty() || std::any_of(scenes.begin(), scenes.end(),
                                    [&](const std::string& scene) { return scene.starts_with(name); });
    if (!known)
      problems.push_back({"study.unknown-name"_code, option, 1, 1,
                          fmt::format("no scenario's name begins with '{}'", name),
                          fmt::format("the scenarios are {}", fmt::join(scenes, ", "))});
  }
}

/// Reads what stands behind the name with `read`; columns are those of the whole option.
template <typename Read>
auto behind_name(const std::string& option, Problems& problems, const Read& read) {
  const auto text = text_behind_name(option);
  const auto skipped = option.size() - text.size();
  Problems own;
  auto made = read(text, own);
  for (auto& problem : own) {
    problem.column += static_cast<int>(skipped);
    problems.push_back(std::move(problem));
  }
  return std::pair(std::move(made), static_cast<int>(skipped));
}

void shift(studies::TunedParameter& parameter, int by) {
  parameter.low_column += by;
  parameter.high_column += by;
}

constexpr auto* largest_option = "--find-max";
constexpr auto* smallest_option = "--find-min";

/// One of the two options, once.
std::optional<studies::BoundRequest> read_request(const EnvelopeOptions& options, const std::string& scene,
                                                  Problems& problems) {
  const auto largest = options_for(scene, options.find_max);
  const auto smallest = options_for(scene, options.find_min);
  const auto count = largest.size() + smallest.size();
  const bool least = largest.empty() && !smallest.empty();
  const auto* option = least ? smallest_option : largest_option;
  if (count != 1) {
    problems.push_back({"study.unknown-name"_code, option, 1, 1,
                        count == 0 ? fmt::format("nothing says what to find of {}", scene)
                        : largest.size() == count || smallest.size() == count
                            ? fmt::format("there are {} of them for {}", count, scene)
                            : fmt::format("{} and {} for {}", largest_option, smallest_option, scene),
                        fmt::format("one for all, or one that begins with {}:", scene)});
    return {};
  }
  auto [request, by] = behind_name(
      least ? smallest[0] : largest[0], problems,
      [&](const std::string& text, Problems& own) { return studies::parse_bound(text, option, least, own); });
  if (request) shift(request->parameter, by);
  return request;
}

/// One scenario of the command line, read and found sound; what is wrong goes to `problems`.
studies::Envelope read_envelope(const EnvelopeOptions& options, const std::filesystem::path& file,
                                Problems& problems) {
  Problems own;
  studies::Envelope envelope;
  envelope.scene = file.stem().string();
  const auto overs = options_for(envelope.scene, options.over);
  std::vector<std::string> given;
  for (const auto& over : overs) given.push_back(text_behind_name(over));
  given = studies::given_paths(given);
  for (const auto& over : overs) {
    auto [axes, by] = behind_name(over, own, [&given](const std::string& text, Problems& told) {
      return studies::parse_over(text, "--over", false, given, told);
    });
    for (auto& axis : axes) {
      shift(axis.parameter, by);
      envelope.axes.push_back(std::move(axis));
    }
  }
  const auto request = read_request(options, envelope.scene, own);
  envelope.question = read_question(options, file, own);
  if (request) envelope.request = *request;
  const bool sound = own.empty();
  if (sound) envelope.points = studies::planned(envelope, own);
  // Whether a value fits is another question for each scenario.
  if (sound && options.scenarios.size() > 1)
    for (auto& problem : own) problem.what = fmt::format("{}: {}", envelope.scene, problem.what);
  problems.insert(problems.end(), own.begin(), own.end());
  return envelope;
}

std::vector<studies::Envelope> read_envelopes(const EnvelopeOptions& options, Problems& problems) {
  std::vector<std::string> scenes;
  for (const auto& file : options.scenarios) {
    auto name = file.stem().string();
    if (std::find(scenes.begin(), scenes.end(), name) != scenes.end())
      problems.push_back({"study.twice"_code, file.string(), 1, 1,
                          fmt::format("there are two scenarios named {}", name),
                          "give each once, with a name of its own"});
    scenes.push_back(std::move(name));
  }
  refuse_unknown_names(options.over, "--over", scenes, problems);
  refuse_unknown_names(options.find_max, largest_option, scenes, problems);
  refuse_unknown_names(options.find_min, smallest_option, scenes, problems);
  std::vector<studies::Envelope> envelopes;
  if (!problems.empty()) return envelopes;
  envelopes.reserve(options.scenarios.size());
  for (const auto& file : options.scenarios) envelopes.push_back(read_envelope(options, file, problems));
  return envelopes;
}

/// A line a point, and the answer in one.
void print_envelope(const studies::Envelope& envelope, bool several) {
  constexpr std::size_t most = 60;
  if (several) fmt::print("{}\n", printable(envelope.scene));
  const auto bands = studies::bands_of(envelope);
  const auto points = !bands.empty() ? bands.size() : envelope.axes.empty() ? 0 : envelope.points.size();
  for (std::size_t i = 0; i < std::min(points, most); ++i)
    fmt::print("  {}\n", printable(bands.empty() ? point_answer(envelope, i)
                                                 : studies::band_answer(envelope, bands[i])));
  if (points > most) fmt::print("  ... and {} points more in {}\n", points - most, envelope_file);
  fmt::print("{}\n", printable(headline(envelope)));
}

}  // namespace

int envelope_scenario(const EnvelopeOptions& options) {
  Problems problems;
  auto envelopes = read_envelopes(options, problems);
  std::optional<OutputFolder> folder;
  if (problems.empty()) folder.emplace(options.out, "envelope", files_of(envelope_file), problems);
  if (!problems.empty()) return bad(problems);
  return in_folder(options, *folder, [&](studies::PointStore& store) {
    std::size_t points = 0;
    for (auto& envelope : envelopes) {
      Countdown bar("seeking, " + envelope.scene);
      studies::seek(envelope, store, [&](std::size_t done, std::size_t of) { bar.show(done, of); });
      bar.clear();
      points += envelope.points.size();
    }
    write_file(folder->add(envelope_file), studies::envelope_table(envelopes).csv());
    auto verdict = studies::write_envelope_report(envelopes, *folder);
    std::vector<studies::PointRow::Verdict> looks;
    for (const auto& envelope : envelopes) {
      print_envelope(envelope, envelopes.size() > 1);
      const auto own = verdicts_of(envelope);
      looks.insert(looks.end(), own.begin(), own.end());
    }
    if (const auto why = studies::why_again(envelopes); !why.empty()) fmt::print("  note {}\n", why);
    if (const auto note = studies::band_note(envelopes); !note.empty()) fmt::print("  note {}\n", note);
    fmt::print("{}, {} values tried, {}: {}\nreport: {}\n", counted(points, "point"), looks.size(),
               studies::counts_of(looks), (options.out / envelope_file).string(),
               (options.out / "report.html").string());
    return finish(std::move(verdict), store, *folder);
  });
}

namespace {

void sweep_options(CLI::App& sweep, int& status) {
  const auto chosen = std::make_shared<SweepOptions>();
  auto& options = *chosen;
  options.out = "out/sweep";

  sweep.add_option("scenario", options.scenario, "Scenario file (.yaml)")->required();
  add_study(
      sweep, options,
      "PATH=A..B UNIT:N, N values from end to end (PATH=A..B UNIT:N:log, each so many times the one before), "
      "PATH=1,2,5 UNIT, or the fit.json of drycut fit: both limits of each value, with --sample what lies "
      "between; may be repeated");
  sweep.get_option("--over")->required();
  sweep.add_option(
      "--sample", options.sample,
      "sobol:N, N points that fill the ranges evenly, in place of the grid; ranges have no :N then");
  sweep.callback([chosen, &status] { status = sweep_scenario(*chosen); });
}

}  // namespace

Verb sweep_verb() {
  return {"sweep",
          "Run a scenario at every point of a grid or a sample: sweep.csv, a row a "
          "point with its verdict, what gave "
          "way first, and figures.\nWhat was interrupted goes on where it was.",
          {"drycut sweep scenes/rotary_knife_mc_camin.yaml",
           "  --over \"plants.web.speed=20..120 m/min:11\" --jobs 2"},
          {"scenario", {FileKind::scenario}},
          sweep_options};
}

namespace {

void envelope_options(CLI::App& envelope, int& status) {
  const auto chosen = std::make_shared<EnvelopeOptions>();
  auto& options = *chosen;
  options.out = "out/envelope";

  envelope.add_option("scenarios", options.scenarios, "Scenario files (.yaml)")->required();
  add_study(
      envelope, options,
      "[NAME:]PATH=A..B UNIT:N[:log], [NAME:]PATH=1,2,5 UNIT, or [NAME:]FILE, the fit.json of drycut fit: "
      "both limits of each value, and the bound has a band; may be repeated. One with NAME: is for the "
      "scenarios whose files' names begin so, in place of those without");
  envelope
      .add_option("--find-max", options.find_max,
                  "[NAME:]PATH=LO..HI UNIT[:TOLERANCE], such as \"plants.web.speed=20..300 m/min:1\"; a "
                  "two-hundredth of the range unless given; or --find-min")
      ->allow_extra_args(false);
  envelope
      .add_option("--find-min", options.find_min,
                  "The smallest value in place of the largest, such as the shortest piece: "
                  "\"variables.length=300..1500 mm:5\"")
      ->allow_extra_args(false);
  envelope.callback([chosen, &status] {
    if (chosen->find_max.empty() && chosen->find_min.empty()) throw CLI::RequiredError("--find-max");
    status = envelope_scenario(*chosen);
  });
}

}  // namespace

Verb envelope_verb() {
  return {
      "envelope",
      "Find the largest value of a parameter up to which every check and "
      "every rating holds, or the smallest, and what fails beyond it: "
      "envelope.csv, a row a point.\nIt tries nine evenly spaced values, up "
      "to 33 where none of them holds, bisects between the last pass and the "
      "first fail down to the tolerance, then samples below the bound: no "
      "stretch stays untried that is wider than a sixteenth of the range, or "
      "than a quarter of its distance from the bound. What fails there ends a "
      "lower bound; that it holds again beyond is told.\n"
      "Several scenarios come into one report.",
      {"drycut envelope scenes/envelope/rotary_knife_camming4.yaml",
       "  --over \"variables.length=500..1400 mm:10\"", "  --find-max \"variables.speed=20..200 m/min:1\""},
      {"scenarios", {FileKind::scenario}},
      envelope_options};
}

}  // namespace drycut::sim::cli
