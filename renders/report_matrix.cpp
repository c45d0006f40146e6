#include "renders/report_matrix.hpp"

#include <fmt/format.h>

#include <map>

#include "base/embedded.hpp"
#include "base/json.hpp"
#include "renders/html.hpp"

namespace drycut::renders {

namespace {

constexpr std::size_t most_labels = 12;  ///< columns that are all written
constexpr int quarters = 4;

std::string_view class_of(MatrixRegion::Kind kind) {
  constexpr std::string_view names[] = {"good", "told", "bad", "broken", "accepted", "none"};
  return names[static_cast<int>(kind)];
}

/// A row's cells; neighbours that are alike are one.
std::string runs_of(const ReportMatrix& matrix, std::size_t row) {
  const auto count = matrix.columns.size();
  const auto region = [&](std::size_t column) { return matrix.region[row * count + column]; };
  std::string runs;
  for (std::size_t column = 0, end = 0; column < count; column = end) {
    for (end = column + 1; end < count && region(end) == region(column);) ++end;
    const auto& of = matrix.regions[region(column)];
    const auto& first = matrix.columns[column];
    const auto where =
        end == column + 1 ? std::string(first) : fmt::format("{} to {}", first, matrix.columns[end - 1]);
    runs += fmt::format(R"(<i class="{}" style="flex:{}" title="{}: {}"></i>)", class_of(of.kind),
                        end - column, html_text(where), html_text(of.label));
  }
  return runs;
}

std::string labels_of(const ReportMatrix& matrix) {
  std::string labels;
  if (matrix.columns.size() <= most_labels) {
    for (const auto& column : matrix.columns)
      labels += fmt::format(R"(<span class="upright">{}</span>)", html_text(column));
    return fmt::format(R"(<div class="labels all">{}</div>)", labels);
  }
  for (std::size_t quarter = 0; quarter < quarters; ++quarter)
    labels +=
        fmt::format("<span>{}</span>", html_text(matrix.columns[quarter * matrix.columns.size() / quarters]));
  return fmt::format(R"(<div class="labels">{}</div>)", labels);
}

std::string legend_of(const ReportMatrix& matrix) {
  std::string legend;
  for (std::size_t i = 0; i < matrix.regions.size(); ++i) {
    std::size_t count = 0;
    for (const auto region : matrix.region) count += region == i ? 1 : 0;
    if (count > 0)
      legend += fmt::format(R"(<span><i class="{}"></i>{}: {}</span>)", class_of(matrix.regions[i].kind),
                            html_text(matrix.regions[i].label), count);
  }
  return fmt::format(R"(<div class="matrix-legend">{}</div>)", legend);
}

}  // namespace

std::string matrix_figure(const ReportMatrix& matrix, std::size_t number) {
  std::string rows;
  for (std::size_t row = 0; row < matrix.rows.size(); ++row)
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td><div class=\"runs\">{}</div></td></tr>\n",
                        html_text(matrix.rows[row]), runs_of(matrix, row));
  return fmt::format(
      "<figure class=\"matrix\" data-matrix=\"{}\">{}<div class=\"field\"><table><thead><tr>"
      "<th>{}</th><th>{}{}</th></tr></thead>\n<tbody>{}</tbody></table></div><div class=\"map-point\"></div>"
      "<figcaption>{}</figcaption></figure>\n",
      number, legend_of(matrix), html_text(matrix.down), html_text(matrix.across), labels_of(matrix), rows,
      html_text(matrix.caption));
}

std::string live_matrices(const std::vector<ReportMatrix>& matrices) {
  if (matrices.empty()) return "";
  auto all = Json::array();
  for (const ReportMatrix& matrix : matrices) {
    // Texts come again and again.
    std::map<std::string, std::size_t> known;
    auto texts = Json::array();
    auto cells = Json::array();
    for (const auto& cell : matrix.cells) {
      auto own = Json::array();
      for (const auto& text : cell) {
        const auto [at, fresh] = known.emplace(text, texts.size());
        if (fresh) texts.push_back(text);
        own.push_back(at->second);
      }
      cells.push_back(std::move(own));
    }
    auto headings = Json::array();
    for (const auto& heading : matrix.headings) headings.push_back(std::string(heading));
    all.push_back({{"columns", matrix.columns.size()},
                   {"rows", matrix.rows.size()},
                   {"headings", headings},
                   {"texts", texts},
                   {"cells", cells},
                   {"fileName", matrix.file_name},
                   {"file", matrix.file}});
  }
  return fmt::format(
      "<script type=\"application/json\" id=\"matrix-data\">{}</script>\n<script>{}</script>\n",
      safe_in_script(all), embedded_file("report_matrix.js"));
}

}  // namespace drycut::renders
