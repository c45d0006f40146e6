#include "sim/studies/fit/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/json.hpp"
#include "base/output_file.hpp"
#include "base/plain_text.hpp"
#include "base/text.hpp"
#include "sim/record/json.hpp"
#include "sim/report/report.hpp"
#include "sim/studies/fit/pictures.hpp"

namespace drycut::sim::studies {

namespace {

constexpr double percent = 100;

std::string limits_text(const FittedValue& value) {
  if (!value.value) return value.known == FitKnown::joined ? "known only together" : "not known";
  return fmt::format("{:.5g} .. {:.5g}", *value.low, *value.high);
}

std::vector<std::string> keys_of(const std::string& path) {
  std::vector<std::string> keys;
  for (std::size_t at = 0; at <= path.size();) {
    const auto dot = std::min(path.find('.', at), path.size());
    keys.push_back(path.substr(at, dot - at));
    at = dot + 1;
  }
  return keys;
}

/// "move.csv, other_move.csv"
std::string sources_text(const FitPlan& plan) {
  std::vector<std::string> names;
  for (const auto& source : plan.sources) names.push_back(source.from.filename().string());
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string other_cutoffs_text(const FittedValue& value) {
  const auto shown = [](const std::optional<double>& one) {
    return one ? fmt::format("{:.5g}", *one) : std::string("-");
  };
  return value.coarser || value.finer ? shown(value.coarser) + " / " + shown(value.finer) : "";
}

std::string error_text(double error) { return fmt::format("{:.3g} %", error * percent); }

std::string delay_text(const std::string& channel, double delay) {
  return fmt::format("{} {:.3g} ms {}", channel, std::abs(delay) * 1000, delay < 0 ? "early" : "late");
}

renders::ReportTable page_table(const Prose& title, const Table& table) {
  renders::ReportTable page{title, {}, {}};
  for (auto& heading : table.headings()) page.headings.emplace_back(std::move(heading));
  for (std::size_t row = 0; row < table.rows().size(); ++row) page.rows.push_back({table.shown(row)});
  return page;
}

Table ladder_table(const FitFound& found) {
  Table table({{"model", "model"},
               {"without", "unexplained without it", "%", 3},
               {"with", "with it", "%", 3},
               {"gain", "gain (BIC)", "", 3},
               {"verdict", "verdict"}});
  for (const auto& rung : found.ladder)
    table.add({rung.model, rung.error_without * percent, rung.error * percent, rung.gain,
               rung.is_worth_it() ? "explains more" : "not needed"});
  return table;
}

std::vector<renders::Plot> plots_of(const FitPlan& plan, const FitFound& found) {
  std::vector<renders::Plot> plots;
  const auto add = [&](const std::vector<Replayed>& all, const std::vector<ReplaySeries>& series,
                       const std::string& kind, const std::string& words) {
    for (std::size_t i = 0; i < std::min(all.size(), series.size()); ++i) {
      const auto name = fmt::format("{}_{}", kind, i + 1);
      plots.push_back(replay_over_time(name, fmt::format("{}: {}", series[i].name(), words), all[i]));
      if (kind != "fit") continue;
      plots.push_back(unexplained_over_speed(name + "_speed", all[i]));
      plots.push_back(unexplained_over_position(name + "_position", all[i]));
    }
  };
  add(found.replayed, plan.recordings, "fit", "recorded and model");
  add(found.tested, plan.tests, "test", "cross test, recorded and model");
  return plots;
}

std::vector<std::string> notes_of(const FitFound& found) {
  std::vector<std::string> notes;
  for (const auto& finding : found.findings) notes.push_back(to_string(finding));
  return notes;
}

renders::Report page(const FitPlan& plan, const FitFound& found) {
  auto page = report::page_of(verdict_of(plan, found));
  page.scenario = plan.question.file.filename().string();
  page.keys.push_back({"unexplained torque",
                       error_text(found.relative_error),
                       {fmt::format("of the recorded one, both rms, below {:.3g} Hz", found.cutoff)}});
  if (found.cross_error)
    page.keys.push_back(
        {"unexplained in the cross test",
         error_text(*found.cross_error),
         {plan.request.limit ? fmt::format("limit {:.3g} %", *plan.request.limit) : "no limit was given"}});
  for (const auto& value : found.parameters)
    if (value.value && page.keys.size() < 6)
      page.keys.push_back({value.path.substr(std::string("plants.").size()),
                           fmt::format("{:.4g} {}", *value.value, value.unit),
                           {limits_text(value), fmt::format("in the scenario {:.4g}", value.before)}});
  page.summary.push_back(page_table("Values, with the limits that hold them in 95 %", fit_table(found)));
  if (!found.ladder.empty())
    page.summary.push_back(page_table("Other models of the machine", ladder_table(found)));
  page.notes = notes_of(found);
  std::vector<std::string> delays;
  for (const auto& [channel, delay] : found.delays) delays.push_back(delay_text(channel, delay));
  page.facts = {
      {{"scenario", plan.question.file.string()}},
      {{"delays, put right", fmt::format("{}", fmt::join(delays, "; "))}},
      {{"cutoff", fmt::format("{:.4g} Hz, without phase, chosen from the data: the narrowest limits of "
                              "those where half the cutoff says the same",
                              found.cutoff)}},
      {{"condition", fmt::format("{:.3g}: largest over least singular value of what the values move; "
                                 "above 30 values cannot be told apart",
                                 found.condition)}},
      {{"replays", fmt::format("{}", found.runs)}}};
  for (const auto& source : plan.sources)
    page.facts.push_back({{"recording", fmt::format("{}, {} rows, FNV-1a {:016x}", source.from.string(),
                                                    source.rows, source.checksum)}});
  return page;
}

}  // namespace

Table fit_table(const FitFound& found) {
  Table table({{"path", "value of"},
               {"value", "value", "", 5},
               {"limits", "limits (95 %)"},
               {"unit", "unit"},
               {"before", "in the scenario", "", 5},
               {"cutoffs", "at half / twice the cutoff"}});
  const auto add = [&](const FittedValue& value, const std::string& path) {
    table.add({path, value.value ? Table::Cell(*value.value) : Table::Cell(std::string("-")),
               limits_text(value), value.unit, value.before, other_cutoffs_text(value)});
  };
  for (const auto& value : found.parameters) add(value, value.path);
  add(found.torque_offset, "offset of " + found.torque_offset.path);
  return table;
}

std::string fit_text(const FitFound& found) {
  auto text = fit_table(found).text(0);
  text += fmt::format("\nunexplained torque: {} of the recorded one (rms, below {:.3g} Hz)\n",
                      error_text(found.relative_error), found.cutoff);
  if (found.inertia_at_motor && found.passed)
    text += fmt::format("inertia of all that the motor moves, with these values: {:.4g} kg m2\n",
                        *found.inertia_at_motor);
  if (found.cross_error) text += fmt::format("in the cross test: {}\n", error_text(*found.cross_error));
  for (const auto& [channel, delay] : found.delays) text += delay_text(channel, delay) + "\n";
  for (const auto& note : notes_of(found)) text += "note: " + printable(note) + "\n";
  return text;
}

record::Verdict verdict_of(const FitPlan& plan, const FitFound& found) {
  record::Verdict verdict;
  verdict.title = fmt::format("{} as recorded", plan.question.file.filename().string());
  const auto known =
      std::ranges::count_if(found.parameters, [](const auto& one) { return one.value.has_value(); });
  verdict.judge(found.passed);
  verdict.word = found.passed ? "FITTED" : "NOT FITTED";
  auto sentence = fmt::format("{} of {} known, {} of the torque unexplained", known,
                              counted(found.parameters.size(), "value"), error_text(found.relative_error));
  if (found.cross_error)
    sentence += fmt::format("; the cross test leaves {}", error_text(*found.cross_error));
  verdict.sentence = sentence;
  verdict.found(found.findings);
  verdict.scenarios = {plan.question.file.string()};
  verdict.counts = {{"known", known},
                    {"unknown", std::ssize(found.parameters) - known},
                    {"replays", static_cast<long long>(found.runs)}};
  return verdict;
}

std::string fitted_text(const FitPlan& plan, const FitFound& found, const std::filesystem::path& folder) {
  const auto scenario = std::filesystem::relative(std::filesystem::absolute(plan.question.file),
                                                  std::filesystem::absolute(folder));
  std::string text = "# Values learnt by drycut fit, with the limits that hold them in 95 %.\n";
  for (const auto& source : plan.sources)
    text += fmt::format("# From {}: {} rows of {}, FNV-1a {:016x}\n", source.file.filename().string(),
                        source.rows, source.from.filename().string(), source.checksum);
  text += fmt::format("extends: {}\n", json_text(Json(scenario.generic_string())));
  std::string entries;
  std::vector<std::string> open;
  std::string limits;
  auto values = found.parameters;
  std::ranges::sort(values, {}, &FittedValue::path);
  for (const auto& value : values) {
    if (!value.value) {
      text += fmt::format("# {} is {}: as before\n", value.path, limits_text(value));
      continue;
    }
    const auto keys = keys_of(value.path);
    std::size_t same = 0;
    while (same < open.size() && same + 1 < keys.size() && open[same] == keys[same]) ++same;
    for (std::size_t i = same; i < keys.size(); ++i) {
      entries += std::string(2 * i, ' ') + keys[i] + ":";
      if (i + 1 < keys.size()) entries += "\n";
    }
    const auto quantity = [&](double number) {
      return fmt::format("{:.6g}{}{}", number, value.unit.empty() ? "" : " ", value.unit);
    };
    entries += fmt::format(" {}  # before {:.5g}\n", quantity(*value.value), value.before);
    limits += fmt::format("  {}: {{low: {}, high: {}, from: {}}}\n", value.path, quantity(*value.low),
                          quantity(*value.high), json_text(Json(sources_text(plan))));
    open = keys;
  }
  return text + entries + (limits.empty() ? "" : "fitted:\n" + limits);
}

int write_fit(const FitPlan& plan, const FitFound& found, OutputFolder& folder, bool pictures) {
  write_file(folder.add(fit_file), json_text(record::json_of(found), 2) + "\n");
  write_file(folder.add(fitted_file), fitted_text(plan, found, folder.path()));
  if (pictures) report::write_report(page(plan, found), plots_of(plan, found), folder);
  const auto verdict = verdict_of(plan, found);
  record::write_verdict(verdict, folder);
  return verdict.exit;
}

}  // namespace drycut::sim::studies
