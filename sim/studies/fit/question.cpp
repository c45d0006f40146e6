#include "sim/studies/fit/question.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/file.hpp"
#include "sim/recordings/recording_file.hpp"
#include "sim/studies/fit/words.hpp"

namespace drycut::sim::studies {

namespace {

Problem option_problem(Code code, const char* option, std::string what, std::string remedy) {
  return {code, option, 1, 1, std::move(what), std::move(remedy)};
}

/// The quantities of a plant by their paths.
std::vector<std::string> quantities_of(scenario::Scenario& scenario) {
  std::vector<std::string> paths;
  for (const auto& plant : scenario.plants)
    for (const auto& row : plant.definition->parameters())
      if (std::holds_alternative<double*>(row.value))
        paths.push_back(FitPath{plant.name.text, row.name}.text());
  return paths;
}

void read_vary(FitPlan& plan, scenario::Scenario& scenario, Problems& problems) {
  std::set<std::string> seen;
  if (plan.request.vary.empty())
    problems.push_back(option_problem("fit.unknown-value"_code, "--vary", "nothing is looked for",
                                      "such as --vary plants.axis.mass"));
  for (const auto& text : plan.request.vary) {
    const auto path = fit_path(text);
    plants::Parameters rows;
    if (!path || quantity_at(scenario, *path, rows) == nullptr) {
      problems.push_back(option_problem("fit.unknown-value"_code, "--vary",
                                        fmt::format("'{}' is no quantity of a plant", text),
                                        did_you_mean(text, quantities_of(scenario),
                                                     "plants.PLANT.PARAMETER, as drycut plants lists them")));
      continue;
    }
    if (!seen.insert(text).second) {
      problems.push_back(option_problem("fit.unknown-value"_code, "--vary",
                                        fmt::format("'{}' is given twice", text), "once"));
      continue;
    }
    if (!plan.question.plant.empty() && path->plant != plan.question.plant) {
      problems.push_back(option_problem(
          "fit.unknown-value"_code, "--vary",
          fmt::format("'{}' is of another plant than '{}'", text, plan.question.vary.front().text()),
          "values of one plant, whose motor was recorded"));
      continue;
    }
    plan.question.plant = path->plant;
    plan.question.vary.push_back(*path);
  }
}

/// A torque whose column says that it is what was asked for.
void doubt_commanded(const recordings::RecordingFile& yaml, const std::string& plant,
                     std::vector<Finding>& findings) {
  for (const auto& channel : yaml.channels) {
    if (channel.name.text != plant + ".motor.torque") continue;
    const auto column = lower(channel.column.text);
    for (const std::string_view word : {"command", "cmd", "target", "demand", "setpoint", "soll"})
      if (column.find(word) != std::string::npos) {
        findings.emplace_back(
            "fit.commanded"_code,
            fmt::format("{}: {} is of the column '{}', which may be what was asked for; viscous friction "
                        "comes out far too large then. Take the measured torque or current",
                        yaml.path.filename().string(), channel.name.text, channel.column.text),
            Finding::Role::warning);
        break;
      }
  }
}

/// Nothing makes a closed loop follow the recording: where its motion is another one counts.
void follow_motion(ReplaySeries& series) {
  series.load = series.motion;
  series.load->channel = series.channel;
  series.load_kind = series.kind;
}

bool looks_for_springs(const FitQuestion& question) {
  return std::ranges::any_of(question.vary,
                             [](const FitPath& path) { return shows(path) == Shows::in_bending; });
}

std::vector<ReplaySeries> read_recordings(const std::vector<std::filesystem::path>& files, FitPlan& plan,
                                          scenario::Scenario& machine, bool are_sources, Problems& problems) {
  std::vector<ReplaySeries> all;
  for (const auto& file : files) {
    Problems own;
    const auto yaml = recordings::read_recording_file(file, own);
    if (own.empty()) {
      doubt_commanded(yaml, plan.question.plant, plan.findings);
      auto recording = recordings::load(yaml, own, plan.findings);
      if (own.empty()) {
        if (auto series = replay_series(recording, file, plan.question, machine, own)) {
          // Where the load is tells about what is between motor and load, and of nothing else.
          if (!looks_for_springs(plan.question)) series->load.reset();
          if (plan.question.closed && !series->load) follow_motion(*series);
          all.push_back(std::move(*series));
        }
        if (are_sources) plan.sources.push_back({file, recording.file, recording.checksum, recording.rows});
      }
    }
    problems.insert(problems.end(), own.begin(), own.end());
  }
  return all;
}

}  // namespace

std::optional<scenario::Scenario> read_question(FitPlan& plan, Problems& problems) {
  auto& question = plan.question;
  question.file = plan.request.scenario;
  question.set = plan.request.set;
  question.closed = plan.request.closed;
  const auto text = read_file(question.file, problems);
  if (!text) return {};
  question.text = *text;
  auto machine = scenario::read_scenario_text(question.text, question.file, question.set, problems);
  if (!problems.empty()) return {};
  read_vary(plan, machine, problems);
  if (question.plant.empty()) return {};
  if (question.closed) {
    strip_onlookers(machine);
    return machine;
  }
  strip(machine);
  if (make_source_of_torque(machine, question.plant)) return machine;
  problems.push_back(option_problem("fit.no-servo"_code, "--vary",
                                    fmt::format("{} has no servo", question.plant),
                                    "a plant with a servo, whose torque was recorded"));
  return {};
}

FitPlan plan_fit(const FitRequest& request, Problems& problems) {
  FitPlan plan;
  plan.request = request;
  auto machine = read_question(plan, problems);
  if (request.recordings.empty() && !plan.question.text.empty())
    problems.push_back(option_problem("fit.no-recording"_code, "--recording", "no recording is named",
                                      "its YAML; drycut import writes one, --plan proposes a move"));
  if (!machine) return plan;
  plan.recordings = read_recordings(request.recordings, plan, *machine, true, problems);
  plan.tests = read_recordings(request.tests, plan, *machine, false, problems);
  return plan;
}

}  // namespace drycut::sim::studies
