#include "sim/studies/compare/measured.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/text.hpp"
#include "sim/scenario/units.hpp"
#include "sim/studies/compare/alignment.hpp"

namespace drycut::sim::studies {

namespace {

// What tells how a plant moves, the best first.
constexpr std::array<std::string_view, 2> speeds = {"speed", "motor.speed"};
constexpr std::array<std::string_view, 4> positions = {"position", "angle.total", "angle", "motor.position"};
constexpr double slow = 0.02;  ///< of the fastest: it hardly moves

double period_of(const ComparedRun& run, const std::string& name, const std::string& unit) {
  constexpr double turn = 360;
  const auto known = run.turns.find(name);
  if (known != run.turns.end()) return known->second;
  return name.ends_with(".angle") && unit == "deg" ? turn : 0;
}

TimedChannel simulated_channel(const ComparedRun& run, const record::Recording::Column& column) {
  TimedChannel made{column.name, column.unit, {}, {}, period_of(run, column.name, column.unit)};
  const auto& times = run.recording.times();
  for (std::size_t i = 0; i < times.size(); ++i) {
    made.times.push_back(seconds(times[i]));
    made.values.push_back(column.values[i]);
  }
  return made;
}

/// Without what could not be recorded.
TimedChannel measured_channel(const recordings::Series& series, double begin, const std::string& unit,
                              double period) {
  auto usable = recordings::without_clipped(series);
  if (scenario::is_unit(unit) && !series.unit.empty())
    for (double& value : usable.value) value = scenario::from_si(value, unit);
  for (double& time : usable.time_s) time -= begin;
  return {series.channel, unit, std::move(usable.time_s), std::move(usable.value), period};
}

/// A pure number is in the run's unit whatever that is called: "bits x4".
bool fits_unit(const std::string& recorded, const std::string& of_run) {
  if (recorded.empty())
    return of_run.empty() || !scenario::is_unit(of_run) || scenario::same_dimension("", of_run);
  return !of_run.empty() && scenario::is_unit(of_run) && scenario::same_dimension(recorded, of_run);
}

/// At ascending `times`, between two samples straight on; outside, its ends.
std::vector<double> values_at(const TimedChannel& channel, const std::vector<double>& times) {
  std::vector<double> values;
  values.reserve(times.size());
  std::size_t i = 0;
  for (const double time : times) {
    while (i + 1 < channel.times.size() && channel.times[i + 1] <= time) ++i;
    double value = channel.values[i];
    if (i + 1 < channel.times.size() && time > channel.times[i]) {
      double way = channel.values[i + 1] - value;
      if (channel.period > 0) way = std::remainder(way, channel.period);
      value += way * (time - channel.times[i]) / (channel.times[i + 1] - channel.times[i]);
    }
    values.push_back(value);
  }
  return values;
}

double rms_of_values(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

std::optional<double> mean_where(const std::vector<double>& values, const std::vector<int>& ways, int way) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (ways[i] != way) continue;
    sum += values[i];
    ++count;
  }
  return count == 0 ? std::nullopt : std::optional(sum / static_cast<double>(count));
}

/// Lays the channels of a recording over those of a run.
class Overlayer {
 public:
  Overlayer(const recordings::RecordingFile& file, const recordings::Recording& recording,
            const ComparedRun& run, double from)
      : file_(file), recording_(recording), run_(run), from_(from), begin_(recording.begin()) {}

  void lay(MeasuredRun& made, const std::vector<std::string>& without, Problems& problems) {
    std::vector<std::string> known;
    for (const auto& series : recording_.series) {
      known.push_back(series.channel);
      if (std::ranges::any_of(without, [&](const auto& name) { return is_named(name, series.channel); }))
        continue;
      const auto* column = run_.recording.column(series.channel);
      if (column == nullptr) {
        made.only_measured.push_back(series.channel);
      } else if (!fits_unit(series.unit, column->unit)) {
        refuse_unit_of(series, column->unit, problems);
      } else if (auto laid = lay(series, *column)) {
        made.channels.push_back(std::move(*laid));
      }
    }
    for (const auto& name : without)
      if (std::ranges::none_of(known, [&](const auto& one) { return is_named(name, one); }))
        problems.push_back({"compare.tolerance"_code, "--without", 1, 1,
                            fmt::format("the recording has no channel '{}'", name),
                            did_you_mean(name, known)});
    if (!made.channels.empty() || !problems.empty()) return;
    std::vector<std::string> recorded;
    for (const auto& column : run_.recording.columns()) recorded.push_back(column.name);
    problems.push_back(
        {"compare.nothing-shared"_code, file_.path.string(), 1, 1,
         fmt::format("the run has none of its channels at the same time; it has {}", listed(recorded)),
         "record them in the scenario: record: {channels: [...]}, by the recording's names"});
  }

 private:
  void refuse_unit_of(const recordings::Series& series, const std::string& unit, Problems& problems) const {
    const auto channel =
        std::ranges::find(file_.channels, series.channel, [](const auto& one) { return one.name.text; });
    problems.push_back(
        file_.problem("scenario.wrong-unit"_code, channel->unit.place,
                      fmt::format("{} is in {} here, in '{}' in the run", series.channel,
                                  series.unit.empty() ? "pure numbers" : "'" + series.unit + "'", unit),
                      "give the column a unit of the same quantity, or name another channel"));
  }

  std::optional<MeasuredChannel> lay(const recordings::Series& series,
                                     const record::Recording::Column& column) const {
    const auto simulated = simulated_channel(run_, column);
    const auto measured = measured_channel(series, begin_, column.unit, simulated.period);
    MeasuredChannel made{column.name, column.unit};
    if (simulated.times.empty()) return {};
    constexpr double rounding = 1e-9;  // [s]
    for (std::size_t i = 0; i < measured.times.size(); ++i) {
      const double time = measured.times[i];
      if (time < std::max(from_, simulated.times.front()) - rounding ||
          time > simulated.times.back() + rounding)
        continue;
      made.times.push_back(time);
      made.measured.push_back(measured.values[i]);
    }
    if (made.times.empty()) return {};
    made.simulated = values_at(simulated, made.times);
    for (std::size_t i = 0; i < made.times.size(); ++i) {
      double apart = made.simulated[i] - made.measured[i];
      if (simulated.period > 0) apart = std::remainder(apart, simulated.period);
      made.residual.push_back(apart);
    }
    judge_residual(made);
    return made;
  }

  void judge_residual(MeasuredChannel& made) const {
    made.rms = rms_of_values(made.residual);
    const double size = rms_of_values(made.measured);
    made.relative = made.rms == 0 ? 0 : size == 0 ? std::numeric_limits<double>::infinity() : made.rms / size;
    for (std::size_t i = 0; i < made.residual.size(); ++i) {
      made.mean += made.residual[i] / static_cast<double>(made.residual.size());
      if (std::abs(made.residual[i]) <= made.worst) continue;
      made.worst = std::abs(made.residual[i]);
      made.worst_at = made.times[i];
    }
    made.speed = motion_of(made, speeds);
    made.position = motion_of(made, positions);
    if (!made.speed) return;
    const auto ways = directions_of(*made.speed);
    made.mean_forwards = mean_where(made.residual, ways, 1);
    made.mean_backwards = mean_where(made.residual, ways, -1);
  }

  template <std::size_t Count>
  std::optional<MeasuredChannel::Motion> motion_of(const MeasuredChannel& of,
                                                   const std::array<std::string_view, Count>& names) const {
    const auto plant = of.name.substr(0, of.name.find('.') + 1);
    if (plant.empty()) return {};
    for (const auto& name : names) {
      const auto full = plant + std::string(name);
      const auto* column = run_.recording.column(full);
      const auto series = std::ranges::find(recording_.series, full, &recordings::Series::channel);
      std::optional<TimedChannel> found;
      if (series != recording_.series.end())
        found = measured_channel(*series, begin_, column != nullptr ? column->unit : series->unit,
                                 column != nullptr ? period_of(run_, full, column->unit) : 0);
      if ((!found || found->times.empty()) && column != nullptr) found = simulated_channel(run_, *column);
      if (found && !found->times.empty())
        return MeasuredChannel::Motion{full, found->unit, values_at(*found, of.times)};
    }
    return {};
  }

  const recordings::RecordingFile& file_;
  const recordings::Recording& recording_;
  const ComparedRun& run_;
  double from_;
  double begin_;
};

void allow(MeasuredRun& made, const std::vector<ComparedRun>& runs,
           const std::vector<std::string>& tolerances, Problems& problems) {
  const auto allowances = read_allowances(tolerances, problems);
  std::vector<std::string> shared;
  for (const auto& channel : made.channels) shared.push_back(channel.name);
  for (const auto& named : allowances.named)
    if (std::ranges::find(shared, named.name) == shared.end())
      problems.push_back({"compare.unknown-name"_code, "--tolerance", 1, 1,
                          fmt::format("{} is no channel that recording and run share", in_quotes(named.name)),
                          did_you_mean(named.name, shared)});
  if (!problems.empty()) return;
  check_allowances(allowances, runs, {}, problems);
  const bool judges_others = std::ranges::any_of(
      tolerances, [](const std::string& text) { return text.find('=') == std::string::npos; });
  for (auto& channel : made.channels) {
    if (!judges_others && allowances.find(channel.name) == nullptr) continue;
    double largest = 0;
    for (const double value : channel.measured) largest = std::max(largest, std::abs(value));
    channel.allowed = allowances.of_channel(channel.name, channel.unit, largest);
  }
}

}  // namespace

std::vector<int> directions_of(const MeasuredChannel::Motion& speed) {
  double fastest = 0;
  for (const double value : speed.values) fastest = std::max(fastest, std::abs(value));
  std::vector<int> ways;
  for (const double value : speed.values)
    ways.push_back(std::abs(value) <= slow * fastest ? 0 : value > 0 ? 1 : -1);
  return ways;
}

MeasuredRun measure_run(const std::filesystem::path& recording, const std::filesystem::path& run, double from,
                        const std::vector<std::string>& without, const std::vector<std::string>& tolerances,
                        Problems& problems) {
  MeasuredRun made;
  made.file = recording;
  const auto file = recordings::read_recording_file(recording, problems);
  recordings::Recording read;
  if (problems.empty()) read = recordings::load(file, problems, made.findings);
  std::vector<ComparedRun> runs;
  runs.push_back(read_run(run, problems));
  if (!problems.empty()) return made;
  Overlayer(file, read, runs.front(), from).lay(made, without, problems);
  if (problems.empty()) allow(made, runs, tolerances, problems);
  made.run = std::move(runs.front());
  return made;
}

}  // namespace drycut::sim::studies
