#include "sim/cam/camming4/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/cam/camming4/judge.hpp"
#include "sim/cam/columns.hpp"

namespace drycut::sim {

namespace {

namespace camming4 = devices::camming4;

constexpr std::size_t most_sectors = 400;  // of sectors that run differently each time round

/// Without what rounding leaves of a zero.
std::string rounded(double value) { return number_text(std::abs(value) < 1e-14 ? 0 : value, 6); }

/// What a row does, in words; a cycloidal code's words are its straight one's.
std::string meaning(const camming4::Row& row) {
  const auto* code = camming4::find_code(row.codeG);
  if (code == nullptr) return "";
  const auto* straight = code->epicycloidal ? camming4::find_code(code->code - 100) : nullptr;
  if (straight != nullptr) return fmt::format("{} (cycloidal)", straight->meaning);
  std::string text(code->meaning);
  if (row.codeG == 137) text += fmt::format(": {}", row.codeQm);
  if (row.codeG == 190) text += fmt::format(": {}, {} times", row.codeQm, row.codeQs);
  if (row.codeG == 160) text += fmt::format(": {} Um", row.codeQm);
  return text;
}

/// A line of the table of sectors, and how often the cam ran it just so.
struct Line {
  std::vector<std::string> cells;
  int times = 1;
};

class Report {
 public:
  Report(const CamTable& table, const CamDuty& duty, const CamRun& run)
      : table_(table), duty_(duty), run_(run) {
    if (duty.master_speed) master_ = *duty.master_speed * um_per_second(table);
  }

  [[nodiscard]] std::string heading() const {
    const auto& axes = table_.settings;
    const auto bit = [](const camming4::Resolution& axis) {
      return rounded(static_cast<double>(axis.measure) / static_cast<double>(axis.pulse));
    };
    auto text = fmt::format("{}: CAMMING4, {} sector{}; 1 bit x4 = {} Um of the master, {} Um of the slave\n",
                            table_.file, table_.count(), table_.count() == 1 ? "" : "s", bit(axes.master),
                            bit(axes.slave));
    if (master_ > 0)
      text += fmt::format("master at {} {} = {} Um/s, sampled every {} ms\n", rounded(*duty_.master_speed),
                          speed_unit(table_), rounded(master_), table_.TCamp);
    if (table_.settings.decpt > 0)
      text +=
          fmt::format("speeds in units of {} Um (decpt {})\n", rounded(std::pow(10, axes.decpt)), axes.decpt);
    return text;
  }

  /// The sectors in the order of running; one that runs again in the same way is only counted.
  Columns sectors() {
    std::size_t passage = 0;
    for (std::size_t i = 0; i <= run_.shown; ++i) {
      for (; passage < run_.passages.size() && run_.passages[passage].visits <= i; ++passage)
        for (const int row : run_.passages[passage].rows) add_row(row);
      if (i < run_.shown) add_visit(run_.visits[i]);
    }
    const bool repeats =
        std::any_of(lines_.begin(), lines_.end(), [](const Line& line) { return line.times > 1; });
    std::vector<bool> words = {false, true, false, false, false, false, false, false};
    std::vector<std::string> names = {"row", "code", "master", "slave", "entry", "exit", "peak v", "peak a"};
    std::vector<std::string> units = {"", "", "Um", "Um", "", "", "", "1/Um"};
    if (master_ > 0) {
      words.insert(words.end(), 3, false);
      names.insert(names.end(), {"time", "peak v", "peak a"});
      units.insert(units.end(), {"s", speed_unit(table_), "Um/s2"});
    }
    if (repeats) {
      words.push_back(false);
      names.emplace_back("times");
      units.emplace_back("");
    }
    words.push_back(true);
    names.emplace_back("what it does");
    Columns columns(words);
    columns.add(names);
    columns.add(units);
    for (const auto& line : lines_) {
      auto cells = line.cells;
      if (repeats) cells.insert(cells.end() - 1, std::to_string(line.times));
      columns.add(std::move(cells));
    }
    return columns;
  }
  /// Of them, how many more run differently each time.
  [[nodiscard]] std::size_t untold() const { return untold_; }

  [[nodiscard]] std::string totals() const {
    std::string text = fmt::format("master total {} Um, slave total {} Um", number_text(run_.master_total()),
                                   number_text(run_.slave_total()));
    if (run_.passes > 1) text += fmt::format(" in {} passes", run_.passes);
    if (master_ > 0) text += fmt::format(", {} s", rounded(run_.master_total() / master_));
    return text + '\n';
  }

 private:
  void add_row(int row) {
    const auto& values = table_.sector(row).row;
    std::vector<std::string> cells = {std::to_string(row), code_text(values.codeG), "", "", "", "", "", ""};
    if (master_ > 0) cells.insert(cells.end(), 3, "");
    cells.push_back(meaning(values));
    count(std::move(cells));
  }

  void add_visit(const CamVisit& visit) {
    const auto& row = table_.sector(visit.row).row;
    const double peak = peak_speed(visit);
    const double gradient = peak_gradient(visit);
    std::vector<std::string> cells = {std::to_string(visit.row),
                                      code_text(row.codeG),
                                      rounded(visit.master_length),
                                      rounded(visit.slave_length),
                                      rounded(visit.entry_speed()),
                                      rounded(visit.exit_speed()),
                                      rounded(peak),
                                      rounded(gradient)};
    if (master_ > 0) {
      cells.push_back(rounded(visit.master_length / master_));
      cells.push_back(rounded(peak * *duty_.master_speed));
      cells.push_back(rounded(gradient * master_ * master_));
    }
    cells.push_back(meaning(row));
    count(std::move(cells));
  }

  void count(std::vector<std::string> cells) {
    const auto [place, fresh] = places_.emplace(cells, lines_.size());
    if (!fresh) {
      if (place->second < lines_.size()) ++lines_[place->second].times;
      return;
    }
    if (lines_.size() < most_sectors)
      lines_.push_back({std::move(cells)});
    else
      ++untold_;
  }

  const CamTable& table_;
  const CamDuty& duty_;
  const CamRun& run_;
  double master_ = 0;  ///< [Um/s], 0 = not given
  std::vector<Line> lines_;
  std::map<std::vector<std::string>, std::size_t> places_;
  std::size_t untold_ = 0;
};

}  // namespace

CamText cam_text(const CamTable& table, const CamDuty& duty, const CamRun& run) {
  Report report(table, duty, run);
  auto columns = report.sectors();
  auto sections = columns.text();
  if (report.untold() > 0)
    sections += fmt::format("  ... and {} more that run differently each time\n", report.untold());
  CamText text{report.heading(), std::move(sections), report.totals()};
  text.tables.emplace_back("Sectors in the order of running", std::move(columns));
  return text;
}

}  // namespace drycut::sim
