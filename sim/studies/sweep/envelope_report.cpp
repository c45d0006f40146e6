#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sim/report/report.hpp"
#include "sim/studies/sweep/answer.hpp"
#include "sim/studies/sweep/band.hpp"
#include "sim/studies/sweep/page.hpp"
#include "sim/studies/sweep/report.hpp"

namespace drycut::sim::studies {

namespace {

constexpr std::string_view end_of_range = "nothing, to the end of the range";

/// What fails beyond a largest value is above it, beyond a smallest below it.
std::string fails_heading(const BoundRequest& request) {
  return request.least ? "fails below" : "fails above";
}

/// The bounds as a page shows them: the bound is the first number.
Studied studied(const Envelope& envelope) {
  const auto& question = envelope.question;
  std::vector<Column> numbered = {named_column(question, envelope.request.parameter)};
  numbered.insert(numbered.end(), question.columns.begin(), question.columns.end());
  auto columns = named_columns(question, envelope.axes);
  columns.insert(columns.end(), {numbered[0],
                                 {"verdict", "verdict"},
                                 {"limit", fails_heading(envelope.request)},
                                 {"rating", "rating"}});
  columns.insert(columns.end(), question.columns.begin(), question.columns.end());
  Studied study{envelope.scene, question, envelope.axes, envelope.points, Table(std::move(columns))};
  study.columns = std::move(numbered);
  renders::MapLines lines{study.columns[0].heading(), {}, {}};
  for (std::size_t i = 0; i < envelope.points.size(); ++i) {
    const auto& bound = envelope.bounds[i];
    const bool good = bound.kind != Bound::Kind::nowhere;
    auto cells = cells_of(envelope.points[i]);
    cells.emplace_back(good ? bound_text(envelope.request, bound) : "");
    cells.emplace_back(std::string(name_of(bound.kind)));
    cells.emplace_back(bound.beyond.limit);
    cells.emplace_back(bound.beyond.rating);
    auto& numbers = study.numbers.emplace_back();
    numbers = {good ? bound.value : unknown};
    numbers.insert(numbers.end(), bound.numbers.begin(), bound.numbers.end());
    numbers.resize(study.columns.size(), unknown);
    cells.insert(cells.end(), numbers.begin() + 1, numbers.end());
    study.table.add(std::move(cells));
    study.good.push_back(good);
    study.kept.push_back(bound.kind == Bound::Kind::throughout);
    study.region.push_back(!good               ? std::string(holds_nowhere)
                           : study.kept.back() ? std::string(end_of_range)
                                               : region_of(bound.beyond));
    lines.values.push_back(numbers[0]);
  }
  study.lines = {std::move(lines)};
  return study;
}

std::vector<Column> x_columns(const Studied& study) { return named_columns(study.question, study.axes); }

/// Scenes whose curves lie on the same axes.
struct Family {
  std::vector<const Envelope*> envelopes;
  std::vector<const Studied*> studies;
  Column of;  ///< what is sought
  [[nodiscard]] bool least() const { return envelopes[0]->request.least; }
  /// "Largest variables.speed"
  [[nodiscard]] std::string sought() const { return sought_text(*envelopes[0]); }
};
std::vector<Family> families_of(const std::vector<Envelope>& envelopes, const std::vector<Studied>& studies) {
  std::vector<Family> families;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    const auto alike = [&](const Family& family) {
      return family.of.is_same(studies[i].columns[0]) && family.least() == envelopes[i].request.least &&
             std::ranges::equal(x_columns(*family.studies[0]), x_columns(studies[i]), &Column::is_same);
    };
    auto family = std::find_if(families.begin(), families.end(), alike);
    if (family == families.end()) family = families.insert(family, Family{{}, {}, studies[i].columns[0]});
    family->envelopes.push_back(&envelopes[i]);
    family->studies.push_back(&studies[i]);
  }
  return families;
}

/// A row a point that any of the scenes has, a column a scene: how far, and what fails beyond it.
renders::ReportTable key_figures(const Family& family) {
  renders::ReportTable table{
      fmt::format("{} {}", family.least() ? "Smallest" : "Largest", family.of.heading()),
      page_headings(Table(x_columns(*family.studies[0]))),
      {}};
  table.verdicts = true;  // what fails stands small under the number
  std::vector<SweepPoint> points;
  for (const auto* study : family.studies) {
    table.headings.push_back(family.studies.size() > 1 ? study->scene : family.of.heading());
    for (const auto& point : study->points)
      if (std::find(points.begin(), points.end(), point) == points.end()) points.push_back(point);
  }
  std::stable_sort(points.begin(), points.end(), [](const SweepPoint& a, const SweepPoint& b) {
    return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(),
        [](const auto& x, const auto& y) { return number_in(x) < number_in(y); });
  });
  for (const auto& point : points) {
    auto cells = short_point(point);
    for (const auto* envelope : family.envelopes) {
      const auto at = std::find(envelope->points.begin(), envelope->points.end(), point);
      if (at == envelope->points.end()) {
        cells.emplace_back("");
        continue;
      }
      const auto& bound = envelope->bounds[static_cast<std::size_t>(at - envelope->points.begin())];
      auto text = bound_text(envelope->request, bound) + "\n";
      text += bound.kind == Bound::Kind::throughout
                  ? "holds to the end of the range"
                  : fmt::format("{}: {}", fails_heading(envelope->request), limit_of(bound.beyond));
      text += elsewhere_text(envelope->request, bound);
      cells.push_back(std::move(text));
    }
    table.rows.push_back({std::move(cells)});
  }
  return table;
}

/// The bound with all that was looked at about it, and what fails beyond it. The axis ends where the range
/// does; what lies far above all bounds is not worth its room.
renders::Panel scene_panel(const Envelope& envelope, const Studied& study, const std::string& title) {
  auto panel = panel_of(study.columns[0], {curve_of(study, 0, "bound; its line only joins the dots")});
  panel.title = title;
  const auto& parameter = envelope.request.parameter;
  constexpr double headroom = 1.15;
  double top = parameter.low;
  for (const auto& bound : envelope.bounds) {
    if (bound.kind == Bound::Kind::nowhere) top = parameter.high;
    top = std::fmax(top, headroom * bound.value);
  }
  top = envelope.request.least ? parameter.high : std::min(top, parameter.high);
  panel.y_range = {parameter.low, top};
  using Style = renders::Curve::Style;
  renders::Curve fails{"fails", {}, {}, Style::points};
  renders::Curve holds{"holds", {}, {}, Style::points};
  for (std::size_t i = 0; i < envelope.points.size(); ++i) {
    for (const auto& look : envelope.bounds[i].looks) {
      if (look.value > top || look.verdict == PointRow::Verdict::refused) continue;
      auto& curve = look.verdict == PointRow::Verdict::passed ? holds : fails;
      curve.x.push_back(number_in(envelope.points[i][0]));
      curve.y.push_back(look.value);
    }
  }
  panel.curves.push_back(std::move(fails));
  panel.curves.push_back(std::move(holds));
  for (const auto& region : regions_of(study)) {
    const bool none = region.label == end_of_range;
    renders::Curve limited{none ? "the end of the range"
                                : fmt::format("{} it: {}", fails_heading(envelope.request), region.label),
                           {},
                           {},
                           Style::points};
    for (std::size_t i = 0; i < study.points.size(); ++i) {
      if (study.region[i] != region.label || !study.good[i]) continue;
      limited.x.push_back(number_in(study.points[i][0]));
      limited.y.push_back(study.numbers[i][0]);
    }
    if (!limited.x.empty()) panel.curves.push_back(std::move(limited));
  }
  return panel;
}

/// The bounds over each other, then each alone.
renders::Plot bounds_plot(const Family& family, const std::string& name) {
  const auto& x = family.studies[0]->table.columns()[0];
  renders::Plot plot{name, fmt::format("{} over {}", family.sought(), x.name), x.heading(), {}};
  const bool several = family.studies.size() > 1;
  if (several) {
    std::vector<renders::Curve> curves;
    curves.reserve(family.studies.size());
    for (const auto* study : family.studies) curves.push_back(curve_of(*study, 0, study->scene));
    plot.panels.push_back(panel_of(family.of, std::move(curves)));
  }
  for (std::size_t i = 0; i < family.studies.size(); ++i)
    plot.panels.push_back(scene_panel(*family.envelopes[i], *family.studies[i],
                                      several ? family.studies[i]->scene : family.of.name));
  return plot;
}

/// What the figures are at the bound, those of the same name over each other.
renders::Plot figures_plot(const Family& family, const std::string& name) {
  renders::Plot plot{name,
                     "At the bound: figures of the pieces and drives",
                     family.studies[0]->table.columns()[0].heading(),
                     {}};
  plot.panel_height = 220;
  std::vector<Column> columns;
  for (const auto* study : family.studies)
    for (auto& column : curve_columns(*study))
      if (!column.is_same(family.of) &&
          std::ranges::none_of(columns, [&](const Column& one) { return one.is_same(column); }))
        columns.push_back(std::move(column));
  for (const auto& column : columns) {
    std::vector<renders::Curve> curves;
    for (const auto* study : family.studies) {
      const auto place = place_of(column, *study);
      if (!place) continue;
      auto curve = curve_of(*study, *place, family.studies.size() > 1 ? study->scene : "");
      if (std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); }))
        curves.push_back(std::move(curve));
    }
    if (!curves.empty()) plot.panels.push_back(panel_of(column, std::move(curves)));
  }
  return plot;
}

/// Of the first point that has a bound, at it.
std::string first_command(const Envelope& envelope, const Studied& study) {
  const auto good = std::find(study.good.begin(), study.good.end(), true);
  if (good == study.good.end()) return "";
  const auto i = static_cast<std::size_t>(good - study.good.begin());
  return point_command(study, study.points[i],
                       {setting(envelope.request.parameter, number_text(study.numbers[i][0]))});
}

record::Verdict verdict_of(const std::vector<Envelope>& envelopes, const std::vector<Studied>& studies) {
  record::Verdict verdict;
  const bool several = studies.size() > 1;
  std::set<std::string> sought;
  std::vector<std::string> spans;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    sought.insert(sought_text(envelopes[i]));
    spans.push_back(fmt::format("{} {}", envelopes[i].scene, span_text(envelopes[i])));
    verdict.scenarios.push_back(studies[i].question.file.generic_string());
    verdict.counts["points"] += std::ssize(studies[i].points);
    for (const auto come : verdicts_of(envelopes[i])) ++verdict.counts[std::string(name_of(come))];
  }
  verdict.title = several ? "Envelopes" : "Envelope of " + studies[0].scene;
  verdict.word = several                             ? fmt::format("{} scenarios", studies.size())
                 : span_text(envelopes[0]) == "none" ? "NONE"
                                                     : "FOUND";
  verdict.sentence = headline(envelopes[0]);
  if (several)
    verdict.sentence =
        fmt::format("{}{}", sought.size() == 1 ? *sought.begin() + ": " : "", fmt::join(spans, "; "));
  return verdict;
}

}  // namespace

record::Verdict write_envelope_report(const std::vector<Envelope>& envelopes, OutputFolder& folder) {
  std::vector<Studied> studies;
  studies.reserve(envelopes.size());
  for (const auto& envelope : envelopes) studies.push_back(studied(envelope));
  auto verdict = verdict_of(envelopes, studies);
  auto report = report::page_of(verdict);
  std::vector<const Studied*> all;
  for (const auto& study : studies) {
    all.push_back(&study);
    report.scenario += (report.scenario.empty() ? "" : ", ") + study.question.file.filename().string();
  }
  report.facts = facts_of(all);
  std::vector<renders::Plot> plots;
  const auto families = families_of(envelopes, studies);
  for (std::size_t k = 0; k < families.size(); ++k) {
    const auto& family = families[k];
    const auto number = families.size() > 1 ? fmt::format("_{}", k + 1) : "";
    const bool curves = std::all_of(family.studies.begin(), family.studies.end(),
                                    [](const Studied* study) { return over_axes(*study, 1); });
    if (family.studies[0]->axes.size() < 2) report.summary.push_back(key_figures(family));
    if (!curves) continue;
    plots.push_back(bounds_plot(family, "envelope" + number));
    plots.push_back(figures_plot(family, "figures" + number));
  }
  for (std::size_t i = 0; i < envelopes.size(); ++i) {
    if (bands_of(envelopes[i]).empty()) continue;
    const auto number = envelopes.size() > 1 ? fmt::format("_{}", i + 1) : "";
    report.summary.insert(report.summary.begin(), band_table(envelopes[i]));
    plots.push_back(band_plot(envelopes[i], "band" + number));
  }
  std::string commands;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    const auto& study = studies[i];
    const auto of = studies.size() > 1 ? study.scene + ": " : "";
    (studies.size() > 1 ? report.tables : report.summary)
        .push_back(counts_of(
            study, of.empty() ? "What fails beyond the bound" : of + "what fails beyond the bound"));
    report.tables.push_back(rows_of(study, of.empty() ? "Every point" : of + "every point"));
    if (over_axes(study, 2)) {
      const auto name = studies.size() > 1 ? fmt::format("map_{}", i + 1) : "map";
      report.maps.push_back(
          map_of(study, name, fmt::format("{}{}", of, sought_text(envelopes[i])),
                 "A dot a bound that was found. Its colour says what fails beyond it, a round "
                 "green one that nothing does; the lines of equal bound are drawn between "
                 "the points.",
                 &envelopes[i].request.parameter, folder));
    } else if (const auto command = first_command(envelopes[i], study); !command.empty()) {
      commands += command + "\n";
    }
  }
  if (!commands.empty())
    report.texts.push_back({studies.size() > 1 ? "The first bound of each scenario, once more with pictures"
                                               : "The first bound, once more with pictures",
                            commands});
  if (const auto why = why_again(envelopes); !why.empty()) report.notes.emplace_back(why);
  if (const auto note = band_note(envelopes); !note.empty()) report.notes.emplace_back(note);
  std::erase_if(plots, [](const renders::Plot& plot) { return plot.panels.empty(); });
  report::write_report(std::move(report), std::move(plots), folder);
  return verdict;
}

}  // namespace drycut::sim::studies
