#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <vector>

#include "base/text.hpp"
#include "devices/camming4/cam_table.hpp"
#include "devices/camming4/table.hpp"
#include "sim/cams/csv.hpp"
#include "sim/cams/kinds.hpp"

namespace drycut::sim::cams {

namespace {

namespace camming4 = devices::camming4;
using camming4::Row;
using camming4::Use;

const std::vector<std::string> columns = {"sector",  "codeG",   "codeQm", "codeQs",
                                          "codeQma", "codeQsa", "codeM"};

/// What the device's own table says of a variable or a field of its record.
struct Entry {
  CamKeyRange range;
  std::string meaning;
};
Entry entry_of(std::string_view name) {
  for (const auto& variable : camming4::table::variables)
    if (variable.name == name)
      return {{variable.min, variable.max},
              variable.unit.empty() ? std::string(variable.meaning)
                                    : fmt::format("{} [{}]", variable.meaning, variable.unit)};
  for (const auto& field : camming4::table::fields)
    if (field.name == name)
      return {{static_cast<double>(field.min), static_cast<double>(field.max)}, std::string(field.meaning)};
  return {};
}
CamKeyRange range_of_variable(std::string_view name) { return entry_of(name).range; }

/// The range of a column under a code (000 1.2.13): narrower than its variable's where the code says so.
CamKeyRange range_of(std::string_view column, Use use, int code) {
  switch (use) {
    case Use::master_space:
    case Use::master_coefficient:
    case Use::master_count:
    case Use::master_count_bits:
    case Use::master_quota:
    case Use::target_row:
      return {0, 999999};
    case Use::radius:
      return {-159154, 159154};
    case Use::displacement_x:
    case Use::displacement_y:
      return {-318308, 318308};
    case Use::slave_space:
      return code == 180 ? CamKeyRange{-318308, 318308} : range_of_variable(column);
    default:
      return range_of_variable(column);
  }
}

class CammingReader {
 public:
  CammingReader(std::string_view text, const std::string& file, Problems& problems)
      : text_(text), told_(file, problems), settings_(told_) {
    table_.file = file;
    const auto take = [&](const char* name, std::int32_t& target) {
      auto [range, meaning] = entry_of(name);
      settings_.whole(name, range, target, std::move(meaning));
    };
    take("measure", measure_);
    take("pulse", pulse_);
    take("measurem", measurem_);
    take("pulsem", pulsem_);
    take("decpt", decpt_);
    take("unitvel", table_.unitvel);
    take("maxvel", table_.maxvel);
    take("taccmax", table_.taccmax);
    take("tdecmax", table_.tdecmax);
    settings_.travel("minpos", "maxpos", range_of_variable("minpos"), table_.travel);
    const auto [range, meaning] = entry_of("TCamp");
    settings_.add(
        {"TCamp", range_text(range), std::to_string(table_.TCamp), meaning}, [this](Cell value, int line) {
          if (value.text.ends_with("ms"))
            value = trimmed({value.text.substr(0, value.text.size() - 2), value.column});
          if (const auto number = whole_number(value, line, "TCamp", range_of_variable("TCamp"), told_))
            table_.TCamp = static_cast<std::int32_t>(*number);
        });
  }

  [[nodiscard]] const std::vector<CamKey>& keys() const { return settings_.keys(); }

  CammingTable read() {
    for (const auto line : split_lines(text_)) {
      if (told_.full()) break;
      ++line_;
      read_line(line);
    }
    if (!told_.full()) check_whole();
    return std::move(table_);
  }

 private:
  void problem(Code code, int line, int column, std::string what, std::string remedy) {
    told_.add(code, line, column, std::move(what), std::move(remedy));
  }
  void problem(Code code, const Cell& cell, std::string what, std::string remedy) {
    problem(code, line_, cell.column, std::move(what), std::move(remedy));
  }

  void read_line(std::string_view line) {
    const Cell cell = trimmed({line, 1});
    if (cell.text.empty()) return;
    const auto cells = split_cells(line);
    if (cell.text.front() == '#')
      settings_.read(cell, line_, !header_.is_read());
    else if (header_.is_read() || !header_.read(cells, line_, told_))
      read_sector(cells);
  }

  /// A whole number in its range, or a problem.
  std::optional<std::int32_t> integer(const Cell& cell, std::string_view name, CamKeyRange range) {
    const auto number = whole_number(cell, line_, name, range, told_);
    if (!number) return {};
    return static_cast<std::int32_t>(*number);
  }

  void read_sector(const std::vector<Cell>& cells) {
    header_.check_width(cells, line_, told_);
    std::optional<std::int32_t> number;
    if (header_.has(0)) number = integer(header_.cell_of(cells, 0), "sector", {1, camming4::cam_rows});
    const camming4::Code* code = header_.has(1) ? read_code(header_.cell_of(cells, 1)) : nullptr;
    const auto use = [&](Use camming4::Code::*column) {
      return code != nullptr ? code->*column : Use::unused;
    };
    Row row;
    row.codeG = code != nullptr ? code->code : 0;
    read_number(cells, 2, use(&camming4::Code::qm), row, row.codeQm);
    read_number(cells, 3, use(&camming4::Code::qs), row, row.codeQs);
    read_number(cells, 4, use(&camming4::Code::qma), row, row.codeQma);
    read_number(cells, 5, use(&camming4::Code::qsa), row, row.codeQsa);
    read_number(cells, 6, Use::unused, row, row.codeM);
    if (number) keep(header_.cell_of(cells, 0), *number, row);
  }

  void read_number(const std::vector<Cell>& cells, std::size_t column, Use use, const Row& row,
                   std::int32_t& target) {
    const Cell cell = header_.cell_of(cells, column);
    if (cell.text.empty()) return;
    const auto& name = columns[column];
    if (const auto number = integer(cell, name, range_of(name, use, row.codeG))) target = *number;
  }

  const camming4::Code* read_code(const Cell& cell) {
    for (const auto& code : camming4::codes) {
      if (cell.text != code.mnemonic) continue;
      problem("cam.value"_code, cell, fmt::format("codeG {} is a name, not a number", in_quotes(cell.text)),
              fmt::format("write {}: {} {}", code.code, code.mnemonic, code.meaning));
      return &code;
    }
    if (cell.text.empty()) {
      problem("cam.missing"_code, cell, "codeG has no value",
              "write an operating instruction, such as 133; 130 does nothing");
      return nullptr;
    }
    const auto number = integer(cell, "codeG", {0, 32767});
    if (!number) return nullptr;
    if (const auto* found = camming4::find_code(*number)) return found;
    const auto* nearest = camming4::codes.data();
    for (const auto& code : camming4::codes)
      if (std::abs(code.code - *number) < std::abs(nearest->code - *number)) nearest = &code;
    problem("cam.unknown-key"_code, cell, fmt::format("there is no codeG {}", *number),
            fmt::format("the nearest is {} {}: {}", nearest->code, nearest->mnemonic, nearest->meaning));
    return nullptr;
  }

  void keep(const Cell& where, int number, const Row& row) {
    auto& sector = table_.sectors[static_cast<std::size_t>(number - 1)];
    if (sector.line > 0) {
      problem("cam.twice"_code, where, fmt::format("sector {} is given twice", number),
              fmt::format("it was first given in line {}; number each sector once", sector.line));
      return;
    }
    sector = {row, line_};
  }

  void check_whole() {
    for (const auto& [ramp, value] : {std::pair{"taccmax", table_.taccmax}, {"tdecmax", table_.tdecmax}}) {
      if (value > 0 && table_.maxvel == 0)
        problem("cam.needs-another"_code, settings_.line_of(ramp), 1,
                fmt::format("{} means nothing without maxvel", ramp),
                "give the speed at 10 V too: # maxvel: 1000");
    }
    settings_.check_travel();
    if (!header_.is_read()) {
      problem("cam.missing"_code, std::max(line_, 1), 1, "there is no table: the header is missing",
              "give the line sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM and a line for each sector");
    } else if (table_.count() == 0 && told_.none()) {
      problem("cam.missing"_code, line_, 1, "the table has no sector",
              "give a line for each sector, such as 1,132,100,50");
    }
    table_.settings = {{measurem_, pulsem_}, {measure_, pulse_}, decpt_};
  }

  std::string_view text_;
  TableProblems told_;
  CammingTable table_;
  int line_ = 0;
  Header header_{columns, 2};
  std::int32_t measure_ = 1, pulse_ = 1, measurem_ = 1, pulsem_ = 1, decpt_ = 0;
  Settings settings_;
};

}  // namespace

CammingTable read_camming4(std::string_view text, const std::string& file, Problems& problems) {
  return CammingReader(text, file, problems).read();
}

std::vector<CamKey> camming4_keys() {
  Problems none;
  return CammingReader("", "", none).keys();
}

std::vector<CamKey> camming4_columns() {
  std::vector<CamKey> made = {
      {columns[0], range_text({1, camming4::cam_rows}), "required", "number of the sector, in any order"}};
  std::vector<std::string> codes;
  codes.reserve(camming4::codes.size());
  for (const auto& code : camming4::codes) codes.push_back(fmt::format("{} {}", code.code, code.mnemonic));
  made.push_back({columns[1], listed(codes), "required", "operating instruction, by its number"});
  for (std::size_t i = 2; i < columns.size(); ++i) {
    const auto [range, meaning] = entry_of(columns[i]);
    made.push_back({columns[i], range_text(range), "0", meaning});
  }
  return made;
}

std::string file_of(CammingTable& table, const std::string& file) {
  const auto& [master, slave, decpt] = table.settings;
  auto text = fmt::format(
      "# measure: {}\n# pulse: {}\n# measurem: {}\n# pulsem: {}\n# decpt: {}\n# unitvel: {}\n# TCamp: {}\n",
      slave.measure, slave.pulse, master.measure, master.pulse, decpt, table.unitvel, table.TCamp);
  if (table.maxvel > 0)
    text += fmt::format("# maxvel: {}\n# taccmax: {}\n# tdecmax: {}\n", table.maxvel, table.taccmax,
                        table.tdecmax);
  if (table.travel.least) text += fmt::format("# minpos: {:.0f}\n", *table.travel.least);
  if (table.travel.most) text += fmt::format("# maxpos: {:.0f}\n", *table.travel.most);
  text += "sector,codeG,codeQm,codeQs,codeQma,codeQsa,codeM\n";
  for (int number = 1; number <= camming4::cam_rows; ++number) {
    if (!table.has(number)) continue;
    const Row& row = table.sector(number).row;
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}\n", number, row.codeG, row.codeQm,
                   row.codeQs, row.codeQma, row.codeQsa, row.codeM);
  }
  table.file = file;
  return text;
}

}  // namespace drycut::sim::cams
