#include "renders/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>
#include <system_error>

#include "base/embedded.hpp"
#include "base/output_file.hpp"
#include "base/sheet.hpp"
#include "renders/html.hpp"
#include "renders/png_image.hpp"
#include "renders/report_data.hpp"

namespace drycut::renders {
namespace {

const char* state(bool passed) { return passed ? "pass" : "fail"; }

/// The page as it grows, with the list of what is on it.
struct ReportPage {
  std::string text;
  std::string contents;
  std::set<std::string> places = {"machine", "plot-data"};  ///< names of anchors that are taken

  void operator+=(const std::string& more) { text += more; }

  /// A place to go to, named after its title.
  std::string place(const std::string& title) {
    std::string name;
    for (const char c : title) {
      const auto byte = static_cast<unsigned char>(c);
      if (std::isalnum(byte) != 0 && byte < 0x80)
        name += static_cast<char>(std::tolower(byte));
      else if (!name.empty() && name.back() != '-')
        name += '-';
    }
    if (name.ends_with('-')) name.pop_back();
    if (name.empty()) name = "part";
    std::string free = name;
    for (int k = 2; !places.insert(free).second; ++k) free = fmt::format("{}-{}", name, k);
    return free;
  }
  void heading(const std::string& title, const std::string& more = "") {
    const std::string name = place(title);
    contents += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", name, html_text(title));
    text += fmt::format("<div class=\"anchor\" id=\"{}\"></div>\n<h2>{}{}</h2>\n", name, html_text(title),
                        more.empty() ? "" : fmt::format(" <small>{}</small>", html_text(more)));
  }
};

/// A box that scrolls where its content is too large, by keyboard too.
std::string scroll_box(const std::string& name) {
  return fmt::format("<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\">\n",
                     html_text(name));
}

/// How much of a limit is used: a bar with the number beside it, red beyond the limit or where it failed.
std::string share_bar(double used, bool failed = false) {
  const auto text = used < 10 ? fmt::format("{:.0f} %", 100 * used) : std::string("over 1000 %");
  return fmt::format(
      "<span class=\"share{0}\" role=\"img\" aria-label=\"{1} of the limit used\"><span class=\"bar\"><i "
      "style=\"width:{2:.4g}%\"></i></span><b>{1}</b></span>",
      used > 1 || failed ? " fail"
      : used > 0.9       ? " close"
                         : "",
      text, std::clamp(100 * used, 0.0, 100.0));
}

/// What the page is headed with, and its colour.
std::string verdict_word(const Report& report) {
  if (!report.word.empty()) return report.word;
  return report.passed ? "PASS" : "FAIL";
}
const char* verdict_state(const Report& report) {
  return report.word.empty() ? state(report.passed) : "told";
}

/// `words` stand in its place for who cannot see it.
std::string picture(const ReportFigure& figure, const std::string& words) {
  const std::string bytes = read_file(figure.png);
  if (bytes.rfind("\x89PNG\r\n", 0) != 0)
    throw std::runtime_error(figure.png.string() + ": not a PNG picture");
  return fmt::format(R"(<img alt="{}" src="data:image/png;base64,{}">)", html_text(words), base64(bytes));
}

std::string caption(const ReportFigure& figure) {
  if (figure.caption.empty()) return "";
  return fmt::format("<figcaption>{}</figcaption>", html_text(figure.caption));
}

/// "12", "-0.5 mm", "800.012 mm": right-aligned, so that digits stand below digits.
bool starts_like_number(const std::string& cell) {
  const std::size_t digit = cell.find_first_not_of("+-. ");
  return digit != std::string::npos && digit <= 2 && cell[digit] >= '0' && cell[digit] <= '9' &&
         cell.size() < 24;
}

/// Columns in which every filled cell is a number.
std::vector<bool> number_columns(const ReportTable& table) {
  std::vector<bool> numbers(table.headings.size(), !table.rows.empty());
  for (std::size_t column = 0; column < numbers.size(); ++column) {
    bool any = false;
    for (const ReportRow& row : table.rows) {
      if (column >= row.cells.size() || row.cells[column].empty()) continue;
      any = true;
      if (!starts_like_number(row.cells[column])) numbers[column] = false;
    }
    if (!any) numbers[column] = false;
  }
  return numbers;
}

void write_head(ReportPage& page, const Report& report) {
  page += "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += fmt::format("<title>{}: {}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n",
                      html_text(verdict_word(report)), html_text(report.title), embedded_file("report.css"));
  page += fmt::format("<header>\n<h1>{}</h1>\n<p>{}</p>\n</header>\n", html_text(report.title),
                      html_text(report.scenario));
  page += fmt::format("<p class=\"verdict {}\"><strong>{}</strong> <span>{}</span></p>\n",
                      verdict_state(report), html_text(verdict_word(report)), html_text(report.verdict));
}

void write_keys(ReportPage& page, const std::vector<ReportKey>& keys) {
  if (keys.empty()) return;
  page += "<dl class=\"keys\">\n";
  for (const ReportKey& key : keys) {
    page +=
        fmt::format("<div><dt>{}</dt><dd><strong>{}</strong>", html_text(key.label), html_text(key.value));
    if (key.used) page += share_bar(*key.used);
    for (const std::string& note : key.notes) page += fmt::format("<small>{}</small>", html_text(note));
    page += "</dd></div>\n";
  }
  page += "</dl>\n";
}

void write_facts(ReportPage& page, const std::vector<ReportRow>& facts) {
  if (facts.empty()) return;
  page += "<dl class=\"facts\">\n";
  for (const ReportRow& fact : facts) {
    std::string value;
    for (std::size_t i = 1; i < fact.cells.size(); ++i) value += (i > 1 ? " " : "") + fact.cells[i];
    // What is long gets room before it is broken.
    const std::string room =
        value.size() > 16 ? fmt::format(" style=\"flex-basis:min(100%,{}ch)\"", value.size() + 4) : "";
    page += fmt::format("<div{}><dt>{}</dt><dd>{}</dd></div>\n", room,
                        html_text(fact.cells.empty() ? "" : fact.cells[0]), html_text(value));
  }
  page += "</dl>\n";
}

/// Those that failed come first.
void write_checks(ReportPage& page, const Report& report) {
  if (report.checks.empty()) return;
  page.heading(report.checks_title);
  page +=
      "<div class=\"scroll checks\">\n<table "
      "class=\"checks\">\n<thead><tr><th>result</th><th>check</th><th>expected</th><th>limit used, "
      "margin</th></tr></thead>\n<tbody>\n";
  for (const bool passed : {false, true}) {
    for (const ReportCheck& check : report.checks) {
      if (check.passed != passed) continue;
      page += fmt::format(R"(<tr class="{0}"><td><span class="badge {0}">{1}</span></td><td>{2})",
                          check.nothing || check.so_far ? "doubt" : state(check.passed),
                          check.so_far    ? "HELD SO FAR"
                          : check.nothing ? "NOT JUDGED"
                          : check.passed  ? "PASS"
                                          : "FAIL",
                          html_text(check.name));
      if (!check.detail.empty()) page += fmt::format("<small>{}</small>", html_text(check.detail));
      page += fmt::format("</td><td><code>{}</code></td><td>{}{}</td></tr>\n", html_text(check.expectation),
                          check.used ? share_bar(*check.used, !check.passed) : "", html_text(check.margin));
    }
  }
  page += "</tbody>\n</table>\n</div>\n";
}

void write_notes(ReportPage& page, const std::vector<std::string>& notes) {
  if (notes.empty()) return;
  page.heading("Notes");
  page += "<ul class=\"notes\">\n";
  for (const std::string& note : notes) page += fmt::format("<li>{}</li>\n", html_text(note));
  page += "</ul>\n";
}

/// The film itself, or where it is if it would make the report too heavy to mail.
void write_video(ReportPage& page, const Report& report) {
  constexpr std::size_t kHeaviest = 24 << 20;
  if (report.video.empty()) return;
  const std::string bytes = read_file(report.video);
  if (bytes.size() > kHeaviest) {
    page += fmt::format("<p>The film: {}, beside this report.</p>\n",
                        html_text(report.video.filename().string()));
    return;
  }
  std::string poster;
  if (!report.poster.empty()) {
    // The controls stand below a picture of this shape, not on its caption.
    const Image image = read_png(report.poster);
    poster = fmt::format(R"( style="--shape:{:.6f}" poster="data:image/png;base64,{}")",
                         static_cast<double>(image.height) / image.width, base64(read_file(report.poster)));
  }
  page += fmt::format(
      "<figure class=\"film\"><video aria-label=\"Film of the run\" controls loop muted playsinline "
      "preload=\"auto\"{} "
      "src=\"data:video/mp4;base64,{}\"></video></figure>\n",
      poster, base64(bytes));
}

void write_frames(ReportPage& page, const Report& report) {
  const std::vector<ReportFigure>& frames = report.frames;
  if (frames.empty()) return;
  page.heading("The run in pictures");
  write_video(page, report);
  page += "<div class=\"strip\" tabindex=\"0\" role=\"region\" aria-label=\"Frames\">\n";
  for (const ReportFigure& frame : frames) {
    page += fmt::format("<figure>{}{}</figure>\n", picture(frame, "The machine, " + frame.caption),
                        caption(frame));
  }
  page += "</div>\n";
}

constexpr int narrowest_alone = 800;  // [pixels] a plot up to here stands beside another

/// Figures whose data, if they have any, begin at `first` in the report's.
void write_figures(ReportPage& page, const Report& report, const std::vector<ReportFigure>& plots,
                   std::size_t first) {
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const std::size_t data = first + i;
    const bool live = data < report.live.size() && can_be_live(report.live[data]);
    const bool narrow = data < report.live.size() && report.live[data].width <= narrowest_alone;
    page += fmt::format("<figure class=\"plot{}\"{}><div class=\"ground\">{}</div>{}</figure>\n",
                        narrow ? " narrow" : "", live ? fmt::format(" data-plot=\"{}\"", data) : "",
                        picture(plots[i], plots[i].words.empty() ? plots[i].caption : plots[i].words),
                        caption(plots[i]));
  }
}

/// The machine stays in sight while one reads the plots.
void write_plots(ReportPage& page, const Report& report) {
  if (report.plots.empty() && !report.view) return;
  page.heading("Measured");
  for (const std::string& unit : report.units)
    page += fmt::format("<p class=\"remark\">{}</p>\n", html_text(unit));
  // The machine stays at the top as far as the box around it goes.
  page += "<div>\n";
  if (report.view) page += view_figure(*report.view);
  write_figures(page, report, report.plots, 0);
  page += "</div>\n";
}

/// "PASS 0.05 mm left\n10 cuts": the badge, the rest, and the second line small.
std::string verdict_cell(const std::string& cell) {
  const bool judged = cell.starts_with("PASS") || cell.starts_with("FAIL");
  const std::size_t word = judged ? 4 : 0;
  const std::size_t end = std::min(cell.find('\n'), cell.size());
  std::string html;
  if (judged)
    html = fmt::format("<span class=\"badge {}\">{}</span>", state(cell[0] == 'P'), cell.substr(0, word));
  html += html_text(cell.substr(word, end - word));
  if (end < cell.size()) html += fmt::format("<small>{}</small>", html_text(cell.substr(end + 1)));
  return html;
}

/// On a phone a row is a card, in which each cell but the first tells its column.
std::string column_name(const ReportTable& table, std::size_t column) {
  if (column == 0 || column >= table.headings.size()) return "";
  return fmt::format(" data-of=\"{}\"", html_text(table.headings[column]));
}

void write_rows(ReportPage& page, const ReportTable& table) {
  const std::vector<bool> numbers = number_columns(table);
  const auto kind = [&](std::size_t column) -> std::string {
    return column < numbers.size() && numbers[column] ? " class=\"number\"" : "";
  };
  // Verdicts are read whole, as checks are.
  page += table.verdicts ? std::string("<div class=\"scroll checks\">\n<table class=\"checks\">\n")
                         : scroll_box(table.title) + "<table>\n";
  std::string head;
  for (std::size_t i = 0; i < table.headings.size(); ++i) {
    head += fmt::format("<th{}>{}</th>", table.verdicts ? "" : kind(i), html_text(table.headings[i]));
  }
  const bool named = std::any_of(table.headings.begin(), table.headings.end(),
                                 [](const std::string& heading) { return !heading.empty(); });
  if (named) page += fmt::format("<thead><tr>{}</tr></thead>\n", head);
  page += "<tbody>\n";
  for (const ReportRow& row : table.rows) {
    page += "<tr>";
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      page += fmt::format("<td{}>{}</td>", table.verdicts ? column_name(table, i) : kind(i),
                          table.verdicts ? verdict_cell(row.cells[i]) : html_text(row.cells[i]));
    }
    page += "</tr>\n";
  }
  page += "</tbody>\n</table>\n</div>\n";
}

void write_table(ReportPage& page, const ReportTable& table) {
  const std::string count = fmt::format("{} {}", table.rows.size(), table.rows.size() == 1 ? "row" : "rows");
  if (table.folded) {
    page += fmt::format("<details><summary>{}<small>{}</small></summary>\n", html_text(table.title), count);
  } else {
    page.heading(table.title, count);
  }
  write_rows(page, table);
  if (table.folded) page += "</details>\n";
}

void write_sections(ReportPage& page, const Report& report) {
  std::size_t data = report.plots.size();
  for (const ReportSection& section : report.sections) {
    page.heading(section.title);
    for (const std::string& note : section.notes)
      page += fmt::format("<p class=\"remark\">{}</p>\n", html_text(note));
    write_figures(page, report, section.plots, data);
    data += section.plots.size();
    for (const ReportTable& table : section.tables) write_table(page, table);
  }
}

void write_text(ReportPage& page, const ReportText& text) {
  page.heading(text.title);
  page += fmt::format("{}<pre>{}</pre></div>\n", scroll_box(text.title), html_text(text.text));
}

/// Links to all that has a heading; none where all is seen at a glance.
std::string contents_of(const ReportPage& page) {
  if (std::count(page.contents.begin(), page.contents.end(), '\n') < 3) return "";
  return fmt::format("<nav class=\"contents\" aria-label=\"Contents\"><ul>\n{}</ul></nav>\n", page.contents);
}

void write_scenario(ReportPage& page, const std::string& expanded) {
  if (expanded.empty()) return;
  page += fmt::format(
      "<details><summary>Scenario with every default in force</summary>\n{}<pre>{}</pre></div>\n</details>\n",
      scroll_box("Scenario with every default in force"), html_text(expanded));
}

}  // namespace

std::string rows_text(const ReportTable& table, std::size_t width) {
  std::vector<std::vector<std::string>> rows = {{table.headings.begin(), table.headings.end()}};
  for (const ReportRow& row : table.rows) rows.push_back(row.cells);
  return in_columns(rows, width);
}

void write_report(const Report& report, const std::filesystem::path& file) {
  ReportPage page;
  write_head(page, report);
  write_keys(page, report.keys);
  write_facts(page, report.facts);
  const std::size_t top = page.text.size();
  write_checks(page, report);
  write_notes(page, report.notes);
  for (const ReportTable& table : report.summary) write_table(page, table);
  for (const ReportText& text : report.texts) write_text(page, text);
  for (std::size_t i = 0; i < report.maps.size(); ++i) page += map_figure(report.maps[i], i);
  for (std::size_t i = 0; i < report.matrices.size(); ++i) {
    page.heading(report.matrices[i].title);
    page += matrix_figure(report.matrices[i], i);
  }
  write_frames(page, report);
  write_plots(page, report);
  write_sections(page, report);
  // What is folded goes to the end: first what is read, then what is looked up.
  for (const bool folded : {false, true}) {
    const bool any = std::any_of(report.tables.begin(), report.tables.end(),
                                 [&](const ReportTable& table) { return table.folded == folded; });
    if (folded && (any || !report.scenario_expanded.empty())) page.heading("Details");
    for (const ReportTable& table : report.tables) {
      if (table.folded == folded) write_table(page, table);
    }
  }
  write_scenario(page, report.scenario_expanded);
  page += "</main>\n";
  if (report.view) page += live_view(*report.view);  // takes its room before the plots do
  page += live_plots(report.live);
  page += live_maps(report.maps);
  page += live_matrices(report.matrices);
  page += "</body>\n</html>\n";
  page.text.insert(top, contents_of(page));
  write_file(file, page.text);
}

}  // namespace drycut::renders
