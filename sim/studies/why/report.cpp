#include "sim/studies/why/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/json.hpp"
#include "base/output_file.hpp"
#include "base/text.hpp"
#include "sim/record/json.hpp"
#include "sim/report/report.hpp"

namespace drycut::sim::studies {

namespace {

std::string at_text(double at) { return fmt::format("{:.6g} s", at); }

std::string failed_text(const WhyFound& found) {
  const auto at = found.failed_at ? " at " + at_text(*found.failed_at) : "";
  return found.check.empty() ? fmt::format("The simulation stopped{}", at)
                             : fmt::format("Check '{}' failed{}", found.check, at);
}

std::string sign_sentence(const WhyFound& found) {
  const auto failed = failed_text(found);
  if (found.sign.empty()) return failed + "; nothing announced it.";
  const auto before =
      found.failed_at ? fmt::format(", {:.4g} s before", *found.failed_at - *found.sign_at) : "";
  return fmt::format("{}; the first sign came at {}{}: {}.", failed, at_text(*found.sign_at), before,
                     found.sign);
}

std::string shortened(const std::string& text) {
  constexpr std::size_t most = 160;  // characters in a sentence
  return text.size() <= most ? text : text.substr(0, most) + " ...";
}

/// "plants.knife.gear: 5 -> 5.1"
std::string text_of(const WeighedDifference& one) {
  const auto kind =
      one.where.rfind(':') != std::string::npos ? Difference::Kind::line : Difference::Kind::value;
  return shortened(Difference{kind, one.where, one.good, one.failed}.text());
}

std::vector<std::string> cause_texts(const WhyFound& found) {
  constexpr std::size_t most = 5;
  std::vector<std::string> texts;
  const auto cause = found.cause();
  for (const auto* one : cause)
    if (texts.size() < most) texts.push_back(text_of(*one));
  if (cause.size() > most) texts.push_back(fmt::format("{} more", cause.size() - most));
  return texts;
}

std::string cause_sentence(const WhyFound& found) {
  if (found.differences.empty())
    return found.because.empty()
               ? "The run itself does not tell why; compare it with one that passes: --good RUN."
               : fmt::format("It failed {}.", found.because);
  const auto texts = fmt::format("{}", fmt::join(cause_texts(found), "; "));
  const auto count = found.cause().size();
  if (!found.minimal)
    return fmt::format(
        "The budget of {} runs ended before the least difference was found: {} of {} are left that fail "
        "together: {}.",
        found.budget, count, found.differences.size(), texts);
  const auto which = found.differences.size() == 1
                         ? std::string("the only difference")
                         : fmt::format("{} of {}", count == 1 ? "one" : fmt::format("{} together", count),
                                       counted(found.differences.size(), "difference"));
  return fmt::format("It fails because of {} ({}){}.", texts, which,
                     found.other_causes ? "; the others fail it without it, too" : "");
}

std::string chain_sentence(const WhyFound& found) {
  constexpr std::size_t most = 3;
  if (found.chain.empty()) return "No fault, alarm, refused command or limit came before it.";
  std::vector<std::string> texts;
  for (const auto& [sign, also_good] : found.chain)
    if (texts.size() < most)
      texts.push_back(fmt::format("{} {} at {}", sign.source, sign.event, at_text(sign.at)));
  const auto more = found.chain.size() > most ? fmt::format(" and {} more", found.chain.size() - most) : "";
  return fmt::format("Before it came, in this order: {}{}.", fmt::join(texts, ", "), more);
}

std::string return_sentence(const WhyFound& found) {
  if (!found.point_of_return) return found.differences.empty() ? chain_sentence(found) : "";
  const auto& point = *found.point_of_return;
  const auto* it = found.cause().size() == 1 ? "it" : "them";
  if (!point.saved)
    return fmt::format("Until when taking {} away would save the run cannot be told: {}.", it, point.unknown);
  return fmt::format("Taken away at {} or before, the run is still saved; at {} it is lost.",
                     at_text(*point.saved), at_text(*point.lost));
}

renders::ReportTable page_table(const Prose& title, const Table& table, bool folded) {
  renders::ReportTable page{title, {}, {}, folded};
  for (auto& heading : table.headings()) page.headings.emplace_back(std::move(heading));
  for (std::size_t row = 0; row < table.rows().size(); ++row) page.rows.push_back({table.shown(row)});
  return page;
}

renders::Curve channel_curve(const std::string& label, const record::Recording& recording,
                             const std::string& channel, double from, double to) {
  renders::Curve curve;
  curve.label = label;
  const auto* column = recording.column(channel);
  if (column == nullptr) return curve;
  for (std::size_t i = 0; i < recording.times().size() && i < column->values.size(); ++i) {
    const double at = seconds(recording.times()[i]);
    if (at < from || at > to) continue;
    curve.x.push_back(at);
    curve.y.push_back(column->values[i]);
  }
  return curve;
}

renders::Curve room_curve(const std::string& label, const RoomOverTime& room, bool by_event, double from,
                          double to) {
  renders::Curve curve;
  curve.label = label;
  if (by_event) curve.style = renders::Curve::Style::points;
  for (const auto& [at, left] : room) {
    if (at < from || at > to) continue;
    curve.x.push_back(at);
    curve.y.push_back(left);
  }
  return curve;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

/// Curves between two moments; no panel = there is nothing to show.
renders::Plot plot_between(const WhyFound& found, const std::string& name, const std::string& title,
                           double from, double to) {
  constexpr std::size_t most_panels = 5;
  const auto& curves = *found.curves;
  const bool pair = !curves.good.columns().empty();
  const std::string failed = pair ? "with the cause" : "this run";
  renders::Plot plot;
  plot.name = name;
  plot.title = title;
  plot.x_label = "time [s]";
  plot.panel_height = 220;
  const auto add = [&](const std::string& panel_title, const std::string& unit,
                       std::vector<renders::Curve> all) {
    std::erase_if(all, [](const renders::Curve& curve) { return curve.x.empty(); });
    if (all.empty() || plot.panels.size() >= most_panels) return;
    plot.panels.push_back({"", with_unit(panel_title, unit), std::move(all), {}, {}});
  };
  add("room of the check", found.unit,
      {room_curve("good", curves.good_room, curves.by_event, from, to),
       room_curve(failed, curves.failed_room, curves.by_event, from, to)});
  if (!plot.panels.empty()) plot.panels.front().bands = {{"limit", 0, 0}};
  for (const auto& channel : curves.channels) {
    const auto* column = curves.failed.column(channel);
    add(channel, column == nullptr ? "" : column->unit,
        {channel_curve("good", curves.good, channel, from, to),
         channel_curve(failed, curves.failed, channel, from, to)});
  }
  const auto mark = [&](std::optional<double> at, const char* label, bool strong) {
    if (at && *at >= from && *at <= to) plot.marks.push_back({*at, label, strong});
  };
  mark(found.sign_at, "first sign", false);
  if (found.point_of_return) mark(found.point_of_return->saved, "last return", false);
  mark(found.failed_at, "failed", true);
  std::ranges::stable_sort(plot.marks, {}, &renders::Mark::x);
  return plot;
}

std::vector<renders::Plot> why_plots(const WhyFound& found) {
  if (!found.curves || found.curves->failed.times().empty()) return {};
  const double end = seconds(found.curves->failed.times().back());
  const double around = std::clamp(0.1 * end, 0.1, 1.0);  // [s]
  const double failed = found.failed_at.value_or(end);
  const double sign = found.sign_at.value_or(failed);
  std::vector<renders::Plot> plots;
  if (failed - sign <= 2 * around) {
    plots.push_back(
        plot_between(found, "moments", "From the first sign to the failure", sign - around, failed + around));
  } else {
    plots.push_back(plot_between(found, "sign", "Around the first sign", sign - around, sign + around));
    plots.push_back(plot_between(found, "failure", "Around the failure", failed - around, failed + around));
  }
  std::erase_if(plots, [](const renders::Plot& plot) { return plot.panels.empty(); });
  return plots;
}

record::Verdict verdict_of(const WhyFound& found) {
  record::Verdict verdict;
  verdict.title = fmt::format("Why {} failed", found.run);
  verdict.judge(found.is_found());
  verdict.word = found.is_found() ? "FOUND" : "NOT FOUND";
  verdict.sentence = cause_sentence(found);
  verdict.found(found.findings);
  verdict.counts = {{"cause", std::ssize(found.cause())},
                    {"chain", std::ssize(found.chain)},
                    {"differences", std::ssize(found.differences)},
                    {"runs", found.runs}};
  verdict.scenarios = {found.run};
  if (!found.good.empty()) verdict.scenarios.push_back(found.good);
  return verdict;
}

}  // namespace

std::vector<std::string> why_sentences(const WhyFound& found) {
  std::vector<std::string> sentences = {sign_sentence(found), cause_sentence(found), return_sentence(found)};
  std::erase(sentences, "");
  return sentences;
}

Table chain_table(const WhyFound& found) {
  Table table({{"at", "time", "s"},
               {"source", "source"},
               {"event", "event"},
               {"text", "what"},
               {"times", "times"},
               {"also_good", "also in the good run"}});
  for (const auto& [sign, also_good] : found.chain)
    table.add({sign.at, sign.source, sign.event, std::string(sign.text), static_cast<double>(sign.times),
               std::string(found.good.empty() ? ""
                           : also_good        ? "yes"
                                              : "no")});
  return table;
}

Table difference_table(const WhyFound& found) {
  Table table({{"where", "where"},
               {"good", "good"},
               {"failed", "fails"},
               {"is_cause", "cause"},
               {"alone", "alone"},
               {"note", "why not tried"}});
  const auto add = [&](const WeighedDifference& one) {
    table.add({one.where, one.good, one.failed, std::string(one.is_cause ? "yes" : ""), one.alone, one.note});
  };
  for (const auto& one : found.differences)
    if (one.is_cause) add(one);
  for (const auto& one : found.differences)
    if (!one.is_cause) add(one);
  return table;
}

int write_why(const WhyFound& found, OutputFolder& folder, bool pictures) {
  auto json = record::json_of(found);
  json["sentences"] = why_sentences(found);
  write_file(folder.add(why_file), json_text(json, 2) + "\n");
  auto verdict = verdict_of(found);
  const int status = verdict.exit;
  if (pictures) {
    auto page = report::page_of(verdict);
    page.scenario = found.run;
    page.facts = {{{"run", found.run}}};
    if (!found.good.empty()) page.facts.push_back({{"good", found.good}});
    if (!found.check.empty()) page.facts.push_back({{"check", found.check}});
    if (!found.detail.empty()) page.facts.push_back({{"what failed", found.detail}});
    if (!found.differences.empty())
      page.facts.push_back({{"simulated runs", fmt::format("{} of at most {}", found.runs, found.budget)}});
    if (!found.because.empty()) page.facts.push_back({{"as the run tells it", "failed " + found.because}});
    if (const auto& part = found.parting)
      page.facts.push_back({{"parts first", fmt::format("{} at {}", part->channel, at_text(part->at))}});
    page.facts.push_back({{"drycut", DRYCUT_VERSION}});
    page.notes = why_sentences(found);
    const auto differences = difference_table(found);
    Table cause(differences.columns());
    for (std::size_t i = 0; i < found.cause().size(); ++i) cause.add(differences.rows()[i]);
    if (!cause.rows().empty())
      page.summary.push_back(page_table("What turns good into failed", cause, false));
    if (!found.chain.empty())
      page.summary.push_back(page_table("Before it failed", chain_table(found), false));
    if (!found.differences.empty()) page.tables.push_back(page_table("All differences", differences, true));
    report::write_report(std::move(page), why_plots(found), folder);
  }
  record::write_verdict(std::move(verdict), folder);
  return status;
}

}  // namespace drycut::sim::studies
