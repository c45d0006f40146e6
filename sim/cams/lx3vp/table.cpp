#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <map>

#include "base/text.hpp"
#include "devices/lx3vp/registers.hpp"
#include "sim/cams/csv.hpp"
#include "sim/cams/lx3vp/judge.hpp"

namespace drycut::sim::cams {

namespace {

using devices::lx3vp::EcamType;

constexpr CamKeyRange whole_32 = {-2147483648.0, 2147483647.0};
constexpr CamKeyRange whole_16 = {0, 65535};
constexpr CamKeyRange ratios = {-1e30, 1e30};  // what a float holds; ECAMTBX itself judges them
constexpr std::size_t most_rows_read = 100000;

/// A parameter of ECAMTBX: its name and what it may be.
struct EcamParameter {
  std::string_view name;
  CamKeyRange range;
  bool real = false;
  bool needed = true;
};
constexpr EcamParameter saw_parameters[] = {{"P1", whole_32},
                                            {"P2", whole_32},
                                            {"P3", whole_32},
                                            {"P4", ratios, true},
                                            {"P5", ratios, true},
                                            {"P6", {0, 4294967295.0}, false, false},
                                            {"P6L", whole_16, false, false},
                                            {"P6H", whole_16, false, false},
                                            {"P7", whole_16, false, false}};
constexpr EcamParameter s_curve_parameters[] = {
    {"P1", whole_32}, {"P2", whole_32}, {"P4", {-32768, 32767}}, {"P5", {-32768, 32767}}, {"P6", whole_16}};

class EcamReader {
 public:
  EcamReader(std::string_view text, const std::string& file, Problems& problems)
      : text_(text), told_(file, problems), settings_(told_) {
    table_.file = file;
    add_settings();
  }

  [[nodiscard]] const std::vector<CamKey>& keys() const { return settings_.keys(); }

  EcamTable read() {
    for (const auto line : split_lines(text_)) {
      if (told_.full()) break;
      ++line_;
      read_line(line);
    }
    if (!told_.full()) finish();
    if (told_.none()) table_.complete();
    return std::move(table_);
  }

 private:
  void add_settings() {
    settings_.whole("max_frequency", {1, 200000}, table_.max_frequency,
                    "words 6-7 of the block: the most that the slave's output gives, else 200000 [pulses/s]");
    settings_.add(
        {"time_axis", "1 to 2147483647", "", "S1 = K of DECAM: the master counts every so many 100 us"},
        [this](const Cell& value, int line) {
          // S1 as the program has it.
          if (const auto number = whole_number(behind_k(value), line, "time_axis", {1, 2147483647}, told_))
            table_.time_axis = static_cast<std::int32_t>(*number);
        });
    settings_.whole("cyclic", {0, 1}, cyclic_, "word 5 of the block: 1 = the cycle repeats itself");
    settings_.travel("min_position", "max_position", whole_32, table_.travel);
    settings_.add(
        {"max_ratio", "1e-09 to 1e+09", "", "slave to master, not to be passed; P5 where ECAMTBX has one"},
        [this](const Cell& value, int line) {
          constexpr double least = 1e-9;
          table_.max_ratio = real_number(value, line, "max_ratio", {least, 1e9}, told_);
        });
    settings_.add({"ecamtbx", "K0, K1, K100, K101", "", "the rows are made by ECAMTBX from parameters"},
                  [this](const Cell& value, int line) { read_type(value, line); });
  }

  void read_type(const Cell& value, int line) {
    const auto number = behind_k(value).text;
    for (const auto type :
         {EcamType::s_curve_0, EcamType::s_curve_1, EcamType::rotary_saw, EcamType::fly_saw})
      if (number == std::to_string(static_cast<int>(type))) table_.type = type;
    if (!table_.type)
      told_.add("cam.unknown-key"_code, line, value.column,
                fmt::format("there is no ecamtbx {}", in_quotes(value.text)),
                "write K0 or K1 S-curve, K100 rotary saw, K101 fly saw");
  }

  void read_line(std::string_view line) {
    const Cell cell = trimmed({line, 1});
    if (cell.text.empty()) return;
    const auto cells = split_cells(line);
    auto& header = settings_.line_of("ecamtbx") > 0 ? parameters_ : rows_;
    if (cell.text.front() == '#') {
      settings_.read(cell, line_, !rows_.is_read() && !parameters_.is_read());
    } else if (&header == &rows_ && cells.front().text == "parameter") {
      told_.add("cam.missing"_code, line_, cell.column, "parameters of what?",
                "say it above: # ecamtbx: K100 (K101, K0, K1)");
      lost_ = true;
    } else if (lost_) {
      return;
    } else if (header.is_read() || !header.read(cells, line_, told_)) {
      header.check_width(cells, line_, told_);
      if (&header == &parameters_)
        read_parameter(cells);
      else
        read_row(cells);
    }
  }

  // Rows.

  void read_row(const std::vector<Cell>& cells) {
    if (!rows_.has(0) || !rows_.has(1)) return;
    const auto master = whole_number(rows_.cell_of(cells, 0), line_, "master", whole_32, told_);
    const auto slave = whole_number(rows_.cell_of(cells, 1), line_, "slave", whole_32, told_);
    if (!master || !slave) return;
    if (table_.rows.size() == most_rows_read) {
      told_.add("cam.out-of-range"_code, line_, 1, fmt::format("more than {} rows", most_rows_read),
                "a block takes 512");
      lost_ = true;
      return;
    }
    table_.rows.push_back({static_cast<std::int32_t>(*master), static_cast<std::int32_t>(*slave)});
    table_.lines.push_back(line_);
  }

  // Parameters.

  [[nodiscard]] std::vector<EcamParameter> known() const {
    if (!table_.type) return {};
    if (table_.is_s_curve()) return {std::begin(s_curve_parameters), std::end(s_curve_parameters)};
    return {std::begin(saw_parameters), std::end(saw_parameters)};
  }

  void read_parameter(const std::vector<Cell>& cells) {
    if (!table_.type || !parameters_.has(0) || !parameters_.has(1)) return;
    const auto name = parameters_.cell_of(cells, 0);
    const auto all = known();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const EcamParameter& p) { return p.name == name.text; });
    if (found == all.end()) {
      refuse_parameter(name, all);
      return;
    }
    const auto [first, fresh] = given_.emplace(name.text, Given{line_, 0});
    if (!fresh) {
      told_.add("cam.twice"_code, line_, name.column, fmt::format("{} is given twice", name.text),
                fmt::format("it was first given in line {}; keep one", first->second.line));
      return;
    }
    first->second.value = read_value(parameters_.cell_of(cells, 1), *found);
  }

  void refuse_parameter(const Cell& name, const std::vector<EcamParameter>& all) {
    std::string names;
    for (const auto& parameter : all) names += (names.empty() ? "" : ", ") + std::string(parameter.name);
    told_.add("cam.unknown-key"_code, line_, name.column,
              fmt::format("there is no parameter {}", in_quotes(name.text)), "there are " + names);
  }

  double read_value(const Cell& cell, const EcamParameter& parameter) {
    if (parameter.real) return real_number(cell, line_, parameter.name, parameter.range, told_).value_or(0);
    if (const auto pattern = hexadecimal(cell.text)) return static_cast<double>(*pattern);
    return static_cast<double>(
        whole_number(behind_k(cell), line_, parameter.name, parameter.range, told_).value_or(0));
  }

  /// K5 is 5.
  static Cell behind_k(const Cell& cell) {
    const bool has_k = cell.text.size() > 1 && (cell.text.front() == 'K' || cell.text.front() == 'k');
    return has_k ? Cell{cell.text.substr(1), cell.column + 1} : cell;
  }

  /// H1000 as the manual writes it.
  static std::optional<std::uint32_t> hexadecimal(std::string_view text) {
    constexpr std::size_t most = 8;
    if (text.size() < 2 || text.size() > most + 1 || (text.front() != 'H' && text.front() != 'h')) return {};
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
  }

  // The whole.

  void finish() {
    table_.cyclic = cyclic_ == 1;
    settings_.check_travel();
    if (lost_) return;
    if (settings_.line_of("ecamtbx") > 0) {
      finish_parameters();
    } else if (!rows_.is_read()) {
      told_.add("cam.missing"_code, std::max(line_, 1), 1, "there is no table: the header is missing",
                "give the line master,slave and a line for each row, or # ecamtbx: K100 and parameter,value");
    } else if (table_.rows.empty() && told_.none()) {
      told_.add("cam.missing"_code, line_, 1, "the table has no row",
                "give a line for each row, such as 0,0");
    }
  }

  void finish_parameters() {
    if (!table_.type) return;
    if (!parameters_.is_read()) {
      told_.add("cam.unknown-key"_code, std::max(line_, 1), 1,
                "there are no parameters: the header is missing",
                "give the line parameter,value and a line for each, such as P1,3183");
      return;
    }
    for (const auto& parameter : known())
      if (parameter.needed && !given_.contains(parameter.name))
        told_.add("cam.missing"_code, line_, 1, fmt::format("{} is missing", parameter.name),
                  fmt::format("give a line {},value", parameter.name));
    const auto whole = given_.find("P6");
    const auto low = given_.find("P6L");
    const auto high = given_.find("P6H");
    if (!table_.is_s_curve() && whole != given_.end())
      for (const auto& part : {low, high})
        if (part != given_.end())
          told_.add("cam.twice"_code, part->second.line, 1,
                    fmt::format("{} is a word of P6, which is given too", part->first),
                    "give P6, or P6L (acceleration) and P6H (cam curve)");
    if (told_.none()) take_parameters();
  }

  [[nodiscard]] double value(std::string_view name) const {
    const auto found = given_.find(name);
    return found == given_.end() ? 0 : found->second.value;
  }
  template <typename Number>
  [[nodiscard]] Number whole(std::string_view name) const {
    return static_cast<Number>(static_cast<std::int64_t>(value(name)));
  }

  void take_parameters() {
    if (table_.is_s_curve()) {
      table_.s_curve = {.length = whole<std::int32_t>("P1"),
                        .top_speed = whole<std::int32_t>("P2"),
                        .acceleration = whole<std::int16_t>("P4"),
                        .deceleration = whole<std::int16_t>("P5"),
                        .resolution = whole<std::uint16_t>("P6")};
      table_.cyclic = table_.cyclic && settings_.line_of("cyclic") > 0;
      return;
    }
    const auto curves = whole<std::uint32_t>("P6");
    table_.saw = {.master_length = whole<std::int32_t>("P1"),
                  .slave_length = whole<std::int32_t>("P2"),
                  .sync_length = whole<std::int32_t>("P3"),
                  .sync_ratio = static_cast<float>(value("P4")),
                  .max_ratio = static_cast<float>(value("P5")),
                  .acceleration = static_cast<std::uint16_t>((curves & 0xFFFF) + whole<std::uint16_t>("P6L")),
                  .curve = static_cast<std::uint16_t>((curves >> 16) + whole<std::uint16_t>("P6H")),
                  .resolution = whole<std::uint16_t>("P7")};
  }

  struct Given {
    int line = 0;
    double value = 0;
  };
  std::string_view text_;
  TableProblems told_;
  EcamTable table_;
  int line_ = 0;
  std::int32_t cyclic_ = 1;
  bool lost_ = false;  ///< what follows cannot be understood
  Header rows_{{"master", "slave"}, 2};
  Header parameters_{{"parameter", "value"}, 2};
  std::map<std::string, Given, std::less<>> given_;
  Settings settings_;
};

}  // namespace

EcamTable read_lx3vp(std::string_view text, const std::string& file, Problems& problems) {
  return EcamReader(text, file, problems).read();
}

std::vector<CamKey> lx3vp_keys() {
  Problems none;
  return EcamReader("", "", none).keys();
}

std::vector<CamKey> lx3vp_columns() {
  const auto whole = range_text(whole_32);
  return {{"master", whole, "required", "position of the master [pulses]"},
          {"slave", whole, "required", "position of the slave [pulses]"},
          {"parameter", "", "",
           "below # ecamtbx, in place of master and slave: P1, P2, ..., as ECAMTBX.md lists them"},
          {"value", "", "", "of the parameter: 5, K5, H1F"}};
}

namespace {

std::string rows_text(const std::vector<devices::lx3vp::CamTableRow>& rows) {
  std::string text = "master,slave\n";
  for (const auto& row : rows) text += fmt::format("{},{}\n", row.master, row.slave);
  return text;
}

}  // namespace

std::string ecam_rows_csv(const EcamTable& table) {
  std::string text;
  if (table.max_frequency != devices::lx3vp::max_frequency_hz)
    text += fmt::format("# max_frequency: {}\n", table.max_frequency);
  if (table.time_axis > 0) text += fmt::format("# time_axis: {}\n", table.time_axis);
  if (table.max_ratio) text += fmt::format("# max_ratio: {}\n", *table.max_ratio);
  if (table.travel.least) text += fmt::format("# min_position: {:.0f}\n", *table.travel.least);
  if (table.travel.most) text += fmt::format("# max_position: {:.0f}\n", *table.travel.most);
  if (!table.cyclic) text += "# cyclic: 0\n";
  return text + rows_text(table.rows);
}

std::string file_of(EcamTable& table, const std::string& file) {
  std::string text;
  if (table.max_frequency > 0) text += fmt::format("# max_frequency: {}\n", table.max_frequency);
  if (table.time_axis != 0) text += fmt::format("# time_axis: {}\n", table.time_axis);
  text += fmt::format("# cyclic: {}\n", table.cyclic ? 1 : 0);
  if (table.travel.least) text += fmt::format("# min_position: {:.0f}\n", *table.travel.least);
  if (table.travel.most) text += fmt::format("# max_position: {:.0f}\n", *table.travel.most);
  if (!table.is_made()) {
    const auto above = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    for (std::size_t i = 1; i <= table.rows.size(); ++i) table.lines.push_back(above + static_cast<int>(i));
    text += rows_text(table.rows);
  } else {
    text += fmt::format("# ecamtbx: K{}\nparameter,value\n", static_cast<int>(*table.type));
    const auto& saw = table.saw;
    const auto& curve = table.s_curve;
    text += table.is_s_curve()
                ? fmt::format("P1,{}\nP2,{}\nP4,{}\nP5,{}\nP6,{}\n", curve.length, curve.top_speed,
                              curve.acceleration, curve.deceleration, curve.resolution)
                : fmt::format("P1,{}\nP2,{}\nP3,{}\nP4,{}\nP5,{}\nP6L,{}\nP6H,{}\nP7,{}\n", saw.master_length,
                              saw.slave_length, saw.sync_length, saw.sync_ratio, saw.max_ratio,
                              saw.acceleration, saw.curve, saw.resolution);
  }
  table.file = file;
  table.complete();
  return text;
}

}  // namespace drycut::sim::cams
