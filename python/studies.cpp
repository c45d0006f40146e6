// Studies of many runs: sweep, envelope, tune. Their tables go to Python as the text of the command's own
// files.
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "python/shared.hpp"
#include "sim/file.hpp"
#include "sim/output_folder.hpp"
#include "sim/studies/sweep/report.hpp"
#include "sim/studies/sweep/study.hpp"
#include "sim/studies/tune/patch.hpp"
#include "sim/studies/tune/plan.hpp"

namespace drycut::python {

namespace {

namespace studies = sim::studies;
using Figures = std::vector<std::pair<std::string, std::string>>;

constexpr auto* points_file = "points.cache";
constexpr int most_jobs = 256;
const ArgumentNames argument_names = {
    {"--figure", "figures"}, {"--constraint", "constraints"}, {"--from", "start"}};

/// Where the files of a study go.
struct StudyPlace {
  std::filesystem::path folder;
  bool kept = false;  ///< with the command's report; else the folder is a temporary one
  int jobs = 1;
};

/// Tells the caller's own thread how far a study is: Python's signals are handled there, and a callback need
/// not know of threads.
class Teller {
 public:
  explicit Teller(py::object callback) : callback_(std::move(callback)) {}
  void operator()(std::size_t done, std::size_t of) {
    if (std::this_thread::get_id() == caller_) tell(done, of);
  }
  /// The last word, also where another thread had it.
  void end(std::size_t of) {
    if (told_ != of) tell(of, of);
  }

 private:
  void tell(std::size_t done, std::size_t of) {
    told_ = done;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!callback_.is_none()) callback_(done, of);
  }
  py::object callback_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::size_t told_ = 0;
};

void check_jobs(int jobs, Problems& problems) {
  if (jobs < 1 || jobs > most_jobs)
    problems.push_back({"study.out-of-range"_code, "jobs", 1, 1,
                        std::to_string(jobs) + " runs at the same time",
                        "1 to " + std::to_string(most_jobs)});
}

bool is_number(const std::string& text) {
  double number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  return read.ec == std::errc() && read.ptr == text.data() + text.size();
}

/// A field of the table has one name: a figure must not be called like another column.
void check_names(const studies::PointQuestion& question, const studies::SweepAxes& axes, Problems& problems) {
  std::set<std::string> taken = {"verdict", "limit", "rating"};
  for (const auto& axis : axes) taken.insert(axis.parameter.path);
  const auto own = question.columns.size() - question.figures.size();
  for (std::size_t i = 0; i < own; ++i) {
    taken.insert(question.columns[i].heading());
    taken.insert(question.columns[i].name);
  }
  for (const auto& figure : question.figures)
    if (figure.name.empty() || !taken.insert(figure.name).second)
      problems.push_back({"study.argument"_code, "figures", 1, 1,
                          "'" + figure.name + "' cannot be the name of a figure",
                          figure.name.empty() ? "give it one" : "a column has this name, give another"});
}

/// "plants.web.speed=20..300 m/min:1", the largest or the smallest; "" = nothing.
struct Sought {
  std::string text;
  bool least = false;
};

struct SweepCall {
  std::filesystem::path file;
  Settings set;
  std::vector<std::string> over;
  Figures figures;
};

/// Reads everything; what is wrong is thrown, all at once.
class Asked {
 public:
  studies::PointQuestion question;
  studies::SweepAxes axes;
  std::optional<studies::BoundRequest> bound;
  std::vector<studies::SweepPoint> points;
  std::optional<sim::OutputFolder> folder;

  Asked(const SweepCall& call, const Sought& sought, std::optional<std::size_t> sample,
        const StudyPlace& place) {
    Problems problems;
    check_jobs(place.jobs, problems);
    auto text = sim::read_file(call.file, problems);
    question.file = call.file;
    question.set = overrides_of(call.set);
    for (const auto& [name, term] : call.figures) question.figures.push_back({name, term});
    axes = studies::parse_axes(call.over, "over", sample.has_value(), problems);
    if (!sought.text.empty())
      bound =
          studies::parse_bound(sought.text, sought.least ? "find_min" : "find_max", sought.least, problems);
    if (text) {
      question.text = std::move(*text);
      studies::prepare(question, problems);
    }
    check_size(sample, problems);
    refuse(problems, argument_names);
    auto all = axes;
    if (bound) all.push_back({bound->parameter, {}});
    check_names(question, all, problems);
    if (bound) {
      studies::Envelope envelope{call.file.stem().string(), question, axes, *bound};
      points = studies::planned(envelope, problems);
      axes = std::move(envelope.axes);
      bound = std::move(envelope.request);
    } else {
      points = studies::planned(axes, sample, question, problems);
    }
    refuse(problems, argument_names);
    const auto* const kind = bound ? "envelope" : "sweep";
    std::vector<std::string> files = {table(), points_file};
    files.insert(files.end(), studies::study_pages.begin(), studies::study_pages.end());
    folder.emplace(place.folder, kind, files, problems);
    refuse(problems, argument_names);
    folder->begin_aside({points_file});
  }

  [[nodiscard]] std::string table() const { return bound ? "envelope.csv" : "sweep.csv"; }
  /// Columns of words; all others are numbers.
  [[nodiscard]] std::vector<std::string> words() const {
    std::vector<std::string> words = {"verdict", "limit", "rating"};
    for (const auto& axis : axes)
      if (!std::all_of(axis.values.begin(), axis.values.end(), is_number))
        words.push_back(heading(axis.parameter));
    return words;
  }

 private:
  void check_size(std::optional<std::size_t> sample, Problems& problems) const {
    if (sample && (*sample < 1 || *sample > studies::most_points))
      problems.push_back({"study.out-of-range"_code, "sample", 1, 1, std::to_string(*sample) + " points",
                          "1 to " + std::to_string(studies::most_points)});
    if (sample && axes.size() > studies::sobol_axes)
      problems.push_back({"study.out-of-range"_code, "sample", 1, 1, std::to_string(axes.size()) + " axes",
                          "a Sobol sequence is over " + std::to_string(studies::sobol_axes) + " at most"});
  }
};

py::dict answer(const Asked& asked, const std::string& csv, std::size_t simulated) {
  std::vector<std::size_t> shape;
  for (const auto& axis : asked.axes) shape.push_back(axis.values.size());
  return py::dict("csv"_a = csv, "words"_a = asked.words(),
                  "axes"_a = column(asked.axes, [](const auto& axis) { return heading(axis.parameter); }),
                  "shape"_a = shape, "figures"_a = asked.question.figures.size(), "simulated"_a = simulated);
}

/// Asks and runs, while other threads of Python go on: `work` runs it and gives the table, and what writes
/// its report.
template <typename Work>
py::dict studied(const SweepCall& call, const Sought& sought, std::optional<std::size_t> sample,
                 const StudyPlace& place, const Work& work) {
  std::optional<Asked> asked;
  std::string csv;
  std::size_t simulated = 0;
  {
    const py::gil_scoped_release unlocked;
    asked.emplace(call, sought, sample, place);
    studies::PointStore store(asked->folder->add(points_file), place.jobs);
    const auto [table, write_report] = work(*asked, store);
    csv = table;
    simulated = store.simulated();
    if (place.kept) {
      write_file(asked->folder->add(asked->table()), csv);
      finish(write_report(), store, *asked->folder);
    } else {
      asked->folder->finish();
    }
  }
  return answer(*asked, csv, simulated);
}

py::dict sweep(const SweepCall& call, std::optional<std::size_t> sample, const StudyPlace& place,
               const py::object& progress) {
  Teller teller(progress);
  return studied(call, {}, sample, place, [&](Asked& asked, studies::PointStore& store) {
    auto rows = studies::sweep(asked.question, asked.axes, asked.points, store, std::ref(teller));
    teller.end(rows.size());
    auto csv = studies::sweep_table(asked.question, asked.axes, asked.points, rows).csv();
    return std::pair(std::move(csv), [&asked, rows = std::move(rows)] {
      return studies::write_sweep_report(asked.question, asked.axes, asked.points, rows, *asked.folder);
    });
  });
}

py::dict envelope(const SweepCall& call, const Sought& bound, const StudyPlace& place,
                  const py::object& progress) {
  Teller teller(progress);
  return studied(call, bound, std::nullopt, place, [&](Asked& asked, studies::PointStore& store) {
    std::vector<studies::Envelope> sought = {
        {call.file.stem().string(), asked.question, asked.axes, *asked.bound, asked.points}};
    studies::seek(sought.front(), store, std::ref(teller));
    auto csv = studies::envelope_table(sought).csv();
    return std::pair(std::move(csv), [&asked, sought = std::move(sought)] {
      return studies::write_envelope_report(sought, *asked.folder);
    });
  });
}

void check_counts(const studies::TuneRequest& request, Problems& problems) {
  check_jobs(request.jobs, problems);
  const auto check = [&](const char* name, int value, int most) {
    if (value < 1 || value > most)
      problems.push_back({"study.out-of-range"_code, name, 1, 1, std::to_string(value) + " runs",
                          "1 to " + std::to_string(most)});
  };
  check("budget", request.budget, 100'000);
  check("spread_runs", request.spread_runs, 10'000);
  if (request.scenarios.empty())
    problems.push_back({"option.missing"_code, "files", 1, 1, "there are none", "give a scenario at least"});
  if (request.vary.empty())
    problems.push_back({"study.argument"_code, "vary", 1, 1, "it is empty",
                        "give a range, such as {\"...AxisX.pgain\": \"1..100\"}"});
}

py::dict tune(const studies::TuneRequest& request, const Settings& set, const std::filesystem::path& out,
              const py::object& progress) {
  Teller teller(progress);
  const auto budget = static_cast<std::size_t>(std::max(0, request.budget));
  std::optional<studies::TunePlan> plan;
  std::optional<studies::Tuned> tuned;
  std::string evaluations;
  std::optional<std::string> spread;
  {
    const py::gil_scoped_release unlocked;
    Problems problems;
    check_counts(request, problems);
    plan = studies::plan_tuning(request, overrides_of(set), problems);
    refuse(problems, argument_names);
    sim::OutputFolder folder(out, "tune", studies::tuning_files, problems);
    refuse(problems, argument_names);
    tuned.emplace(
        studies::tune(*plan, request, request.jobs, folder, [&](const char* /*doing*/, double share) {
          teller(static_cast<std::size_t>(share * static_cast<double>(budget)), budget);
        }));
    teller.end(budget);
    evaluations = sim::read_file(out / studies::evaluations_file, problems).value_or("");
    if (tuned->spread) spread = sim::read_file(out / studies::spread_file, problems);
  }
  const auto& found = tuned->found;
  py::dict values;
  Settings settings;
  if (const auto answer = found.answer()) {  // present values that only the program knows stay as they are
    for (std::size_t i = 0; i < plan->vary.size(); ++i) values[py::str(plan->vary[i].path)] = (*answer)[i];
    for (const auto& override : studies::overrides_of(plan->vary, *answer))
      settings[override.path] = override.value;
  }
  py::dict units;
  for (const auto& parameter : plan->vary) units[py::str(parameter.path)] = parameter.unit;
  return py::dict("passed"_a = found.after().feasible(), "values"_a = values, "units"_a = units,
                  "settings"_a = settings, "metric"_a = found.after().metric,
                  "metric_before"_a = found.before.metric, "summary"_a = studies::summary_text(found),
                  "patch"_a = studies::patch_text(found), "evaluations"_a = evaluations, "spread"_a = spread,
                  "simulated"_a = tuned->trials->simulated());
}

}  // namespace

void add_studies(py::module_& module) {
  module.def(
      "sweep",
      [](const std::filesystem::path& file, const Settings& set, const std::vector<std::string>& over,
         const Figures& figures, std::optional<std::int64_t> sample, int jobs,
         const std::filesystem::path& folder, bool kept, const py::object& progress) {
        if (sample && *sample < 0) sample = 0;  // refused as such
        return sweep({file, set, over, figures}, sample, {folder, kept, jobs}, progress);
      },
      "file"_a, "set"_a, "over"_a, "figures"_a, "sample"_a, "jobs"_a, "folder"_a, "kept"_a, "progress"_a);
  module.def(
      "envelope",
      [](const std::filesystem::path& file, const Settings& set, const std::vector<std::string>& over,
         const std::string& find, bool least, const Figures& figures, int jobs,
         const std::filesystem::path& folder, bool kept, const py::object& progress) {
        return envelope({file, set, over, figures}, {find, least}, {folder, kept, jobs}, progress);
      },
      "file"_a, "set"_a, "over"_a, "find"_a, "least"_a, "figures"_a, "jobs"_a, "folder"_a, "kept"_a,
      "progress"_a);
  module.def(
      "tune",
      [](const std::vector<std::filesystem::path>& files, const Settings& set,
         const std::vector<std::string>& vary, const std::string& minimise,
         const std::vector<std::string>& constraints, const std::string& start, bool ignore_checks,
         const std::string& wire, const std::optional<std::string>& at, double amplitude, int budget,
         std::uint64_t seed, const std::vector<std::string>& spread, int spread_runs, int jobs,
         const std::filesystem::path& folder, bool kept, const py::object& progress) {
        studies::TuneRequest request;
        request.scenarios = files;
        request.vary = vary;
        request.minimise = minimise;
        request.constraints = constraints;
        request.from = start;
        request.ignore_checks = ignore_checks;
        request.loop.wire = wire;
        request.loop.at = at;
        request.loop.amplitude = amplitude;
        request.budget = budget;
        request.seed = seed;
        request.spread = spread;
        request.spread_runs = spread_runs;
        request.jobs = jobs;
        request.pictures = kept;
        return tune(request, set, folder, progress);
      },
      "files"_a, "set"_a, "vary"_a, "minimise"_a, "constraints"_a, "start"_a, "ignore_checks"_a, "wire"_a,
      "at"_a, "amplitude"_a, "budget"_a, "seed"_a, "spread"_a, "spread_runs"_a, "jobs"_a, "folder"_a,
      "kept"_a, "progress"_a);
}

}  // namespace drycut::python
