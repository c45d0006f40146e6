#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include <fmt/format.h>

#include "base/state_archive.hpp"
#include "devices/plcopen/tab_file.hpp"

// Cams as files of their own: CSV, and what comments say of the axes.
namespace drycut::devices::plcopen {
namespace {

constexpr int most_modulo = 2147483647;

class CamReader {
 public:
  CamReader(const std::string& file, Problems& problems) : reader_(file, problems) {}

  std::optional<CamFile> csv(std::string_view text) {
    cam_.table = {.file = {}, .name = {}, .id = 1, .type = 0, .values = {}};
    read_csv(text);
    if (!seen_.contains("interpolation") && cam_.table.type == 7)
      cam_.interpolation = Interpolation::poly5_line;
    if (!seen_.contains("interpolation") && cam_.table.type == 5)
      cam_.interpolation = Interpolation::polynom_3_koeff;
    cam_.table.interpolation = cam_.interpolation;
    cam_.table.places = reader_.rows();
    return finished();
  }

  /// What the comments of a .tab file say, for its table.
  std::optional<CamFile> tab(std::string_view text, McCamTable table) {
    tab_ = true;
    cam_.interpolation = table.interpolation;
    cam_.table = std::move(table);
    if (!cam_.table.places.empty()) cam_.header = cam_.table.places.front();
    int number = 0;
    for (const std::string_view line : split_lines(text)) {
      ++number;
      if (const std::size_t sign = line.find('#'); sign != std::string_view::npos)
        read_key(line.substr(sign), static_cast<int>(sign), number);
    }
    return finished();
  }

  /// Nullopt if the comments had a fault.
  std::optional<CamFile> finished() {
    if (!reader_.sound()) return std::nullopt;
    cam_.master_modulo_given = seen_.contains("master_modulo");
    if (!seen_.contains("slave_unit") && cam_.slave_modulo == 0) cam_.slave_unit = "mm";
    return std::move(cam_);
  }

 private:
  void read_csv(std::string_view text) {
    constexpr const char* columns = "write slave, or master,slave, or a0,a1,a2,a3";
    char separator = ',';
    bool header = false;
    int number = 0;
    for (const std::string_view line : split_lines(text)) {
      ++number;
      const Word whole = word_at(line, number, 0, line.size());
      if (whole.text.empty()) continue;
      if (whole.text.front() == '#') {
        read_key(whole.text, whole.place.column - 1, number);
      } else if (!header) {
        header = true;
        cam_.header = number;
        separator = line.find(';') != std::string_view::npos ? ';' : ',';
        cam_.table.type = type_of(split(line, number, separator));
        if (cam_.table.type == 0)
          return reader_.fault("cam.unknown-key"_code, whole.place,
                               fmt::format("unknown header '{}'", whole.text), columns);
      } else {
        reader_.row(cam_.table, split(line, number, separator), separator == ';');
      }
    }
    if (!header)
      reader_.fault("cam.unknown-key"_code, {std::max(number, 1), 1}, "there is no header", columns);
  }

  /// The table's type by its header; 0 if it is none.
  static int type_of(const Words& header) {
    std::string joined;
    for (const Word& word : header) joined += lower(word.text) + ' ';
    if (joined == "slave ") return 3;
    if (joined == "master slave ") return 7;
    return joined == "a0 a1 a2 a3 " ? 5 : 0;
  }

  [[nodiscard]] std::vector<std::string> keys() const {
    std::vector<std::string> keys;
    for (const CamFileKey& key : cam_file_keys())
      if (!tab_ || !key.in_csv_only) keys.emplace_back(key.name);
    return keys;
  }

  /// A comment, which stands `before` characters from the line's beginning.
  void read_key(std::string_view comment, int before, int line) {
    const std::size_t colon = comment.find(':');
    if (colon == std::string_view::npos || comment.starts_with("##")) return;
    Word key = word_at(comment, line, 1, colon);
    Word value = word_at(comment, line, colon + 1, comment.size());
    key.place.column += before;
    value.place.column += before;
    const std::string name = lower(key.text);
    const auto known = keys();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      // What a .tab says beside its table is its maker's affair, but for a slip of a key.
      const bool is_word = key.text.find(' ') == std::string_view::npos;
      if (is_word && (!tab_ || !nearest(name, known).empty())) refuse(key, known);
      return;
    }
    if (const auto [first, is_new] = seen_.try_emplace(name, line); !is_new)
      return reader_.fault("cam.twice"_code, key.place, fmt::format("a second {}", name),
                           fmt::format("the first is in line {}", first->second));
    take(name, value);
  }

  void refuse(const Word& key, const std::vector<std::string>& known) {
    const std::string guess = nearest(lower(key.text), known);
    std::string all;
    for (const std::string& name : known) all += (all.empty() ? "" : ", ") + name;
    reader_.fault("cam.unknown-key"_code, key.place, fmt::format("unknown key '{}'", key.text),
                  (guess.empty() ? "known are " + all : fmt::format("did you mean {}?", guess)) +
                      "; a remark begins with ##");
  }

  void take(const std::string& name, const Word& value) {
    CamFileLimits& limits = cam_.table.limits;
    constexpr double most = 1e12;
    if (name == "name") cam_.table.name = value.text;
    if (name == "id") cam_.table.id = static_cast<std::uint16_t>(reader_.whole(value, 1, 65535).value_or(1));
    if (name == "master_modulo") take_modulo(value, 1, cam_.master_modulo);
    if (name == "slave_modulo") take_modulo(value, 0, cam_.slave_modulo);
    if (name == "endless") take_endless(value);
    if (name == "periodic") cam_.periodic = one_of(name, value, {"yes", "no"}) != "no";
    if (name == "master_unit") cam_.master_unit = one_of(name, value, {"deg", "mm"});
    if (name == "slave_unit") cam_.slave_unit = one_of(name, value, {"deg", "mm"});
    if (name == "maxvel") limits.velocity = reader_.real(value, 1e-9, most);
    if (name == "maxacc") limits.acceleration = reader_.real(value, 1e-9, most);
    if (name == "maxjerk") limits.jerk = reader_.real(value, 1e-9, most);
    if (name == "minpos") limits.least = reader_.real(value, -most, most);
    if (name == "maxpos") limits.most = reader_.real(value, -most, most);
    if (name == "interpolation") take_interpolation(value);
  }

  void take_modulo(const Word& value, int least, double& modulo) {
    if (const auto number = reader_.whole(value, least, most_modulo)) modulo = *number;
  }

  void take_endless(const Word& value) {
    const std::string direction = one_of("endless", value, {"positive", "negative", "no"});
    if (direction == "positive") cam_.endless = Endless::positive;
    if (direction == "negative") cam_.endless = Endless::negative;
  }

  void take_interpolation(const Word& value) {
    const std::optional<Interpolation> type = parse_interpolation(value.text);
    if (!type || *type == Interpolation::table_defined)
      reader_.fault("cam.interpolation"_code, value.place,
                    fmt::format("'{}' is no interpolation (error 42006)", value.text),
                    "write STEP_DIRECT, LINEAR, POLYNOM_3, POLYNOM_3_KOEFF, LINE_POLY5 or POLY5_LINE");
    cam_.interpolation = type.value_or(Interpolation::linear);
  }

  /// The word in small letters; the first of the choice, with a fault, if it is none of them.
  std::string one_of(std::string_view name, const Word& value, const std::vector<std::string>& choice) {
    std::string word = lower(value.text);
    if (std::find(choice.begin(), choice.end(), word) != choice.end()) return word;
    std::string all;
    for (std::size_t i = 0; i < choice.size(); ++i)
      all += (i == 0 ? "" : i + 1 == choice.size() ? " or " : ", ") + choice[i];
    reader_.fault("cam.value"_code, value.place, fmt::format("{} cannot be '{}'", name, value.text),
                  "write " + all);
    return choice.front();
  }

  TableReader reader_;
  CamFile cam_;
  std::map<std::string, int> seen_;
  bool tab_ = false;
};

std::string remedy_of(ErrorId error) {
  switch (error) {
    case ErrorId::table_type_mismatch:
      return "STEP_DIRECT, LINEAR, POLYNOM_3 take one column, POLYNOM_3_KOEFF a0..a3, LINE_POLY5 and "
             "POLY5_LINE "
             "master and slave";
    case ErrorId::unknown_interpolation:
      return "write Functiontype = 0..5, or # interpolation: LINEAR for the block's TableFctType";
    case ErrorId::table_master_order:
      return "let the masters ascend inside one turn";
    case ErrorId::table_line_count:
      return "add or take away a line";
    case ErrorId::position_range:
      return "keep positions within +-1e12";
    case ErrorId::too_few_lines:
      return "write one line at least";
    case ErrorId::not_modulo:
      return "give slave_modulo a length";
    default:
      return "";
  }
}

}  // namespace

std::span<const CamFileKey> cam_file_keys() {
  static constexpr std::string_view positive = "1e-9 to 1e12";
  static constexpr std::string_view any = "-1e12 to 1e12";
  static constexpr std::array keys = {
      CamFileKey{"interpolation", "STEP_DIRECT, LINEAR, POLYNOM_3, POLYNOM_3_KOEFF, LINE_POLY5, POLY5_LINE",
                 "LINEAR",
                 "the law between the rows; unless given POLY5_LINE of master,slave and POLYNOM_3_KOEFF of "
                 "a0,a1,a2,a3"},
      CamFileKey{"endless", "positive, negative, no", "no", "a slave that goes on turn after turn"},
      CamFileKey{"master_modulo", "1 to 2147483647", "3600000",
                 "a turn of the master [0.0001 deg or 0.1 um]"},
      CamFileKey{"slave_modulo", "0 to 2147483647", "3600000",
                 "a turn of the slave, 0 = a linear one [0.0001 deg or 0.1 um]"},
      CamFileKey{"periodic", "yes, no", "yes", "StartMode F_PERIODIC: the cam repeats itself"},
      CamFileKey{"master_unit", "deg, mm", "deg", "what 10000 of the master's increments are one of"},
      CamFileKey{"slave_unit", "deg, mm", "deg", "the same of the slave; mm where slave_modulo is 0"},
      CamFileKey{"maxvel", positive, "", "limit of the slave's velocity [deg/s or mm/s]"},
      CamFileKey{"maxacc", positive, "", "limit of its acceleration [deg/s2 or mm/s2]"},
      CamFileKey{"maxjerk", positive, "", "limit of its jerk [deg/s3 or mm/s3]"},
      CamFileKey{"minpos", any, "", "lower end of the slave's travel [0.0001 deg or 0.1 um]"},
      CamFileKey{"maxpos", any, "", "upper end of it"},
      CamFileKey{"name", "a text", "", "of the table, as programs call it", true},
      CamFileKey{"id", "1 to 65535", "1", "of the table", true}};
  return keys;
}

std::vector<CamRefusal> refusals(const CamFile& cam) {
  std::vector<CamRefusal> found;
  const auto add = [&](ErrorId error, std::size_t row = 0) {
    found.push_back({error, row, remedy_of(error)});
  };
  const bool pairs = cam.table.type == 7;
  if (cam.slave_modulo == 0 && (pairs || cam.endless != Endless::no)) add(ErrorId::not_modulo);
  if (cam.interpolation == Interpolation::table_defined) {
    add(ErrorId::unknown_interpolation);
    return found;
  }
  const ErrorId error = check(cam.table, cam.interpolation, cam.master_modulo);
  const bool right_type = error != ErrorId::table_type_mismatch && pairs;
  const auto rows = right_type ? disordered_rows(cam.table, cam.master_modulo) : std::vector<std::size_t>{};
  for (const std::size_t row : rows) add(ErrorId::table_master_order, row);
  if (error != ErrorId::none && (error != ErrorId::table_master_order || rows.empty())) add(error);
  return found;
}

std::optional<CamFile> read_cam(std::string_view text, const std::string& file, Problems& problems) {
  text = without_byte_order_mark(text);
  bool csv = true;
  for (const std::string_view line : split_lines(text)) {
    const std::string_view word = trimmed(line);
    if (word.empty() || word.front() == '#') continue;
    csv = word.find('=') == std::string_view::npos && lower(word) != "begintable";
    break;
  }
  CamReader reader(file, problems);
  if (csv) {
    std::optional<CamFile> cam = reader.csv(text);
    if (cam) cam->table.file = file;
    return cam;
  }
  std::optional<McCamTable> table = parse_tab(text, file, problems);
  // The comments' faults are told even where the table has its own.
  std::optional<CamFile> cam = reader.tab(text, table.value_or(McCamTable{}));
  return table ? cam : std::nullopt;
}

std::optional<CamFile> parse_cam_csv(std::string_view text, const std::string& file, Problems& problems,
                                     const std::vector<MasterTurn>& masters) {
  std::optional<CamFile> cam = CamReader(file, problems).csv(without_byte_order_mark(text));
  if (!cam) return std::nullopt;
  cam->table.file = file;
  std::vector<CamRefusal> refused = refusals(*cam);
  std::string behind;
  for (const MasterTurn& master : cam->master_modulo_given ? std::vector<MasterTurn>{} : masters) {
    cam->master_modulo = master.modulo;
    std::vector<CamRefusal> here = refusals(*cam);
    const bool fits = here.empty();
    if (fits || behind.empty()) {
      refused = std::move(here);
      behind = fmt::format(" behind {}, whose turn is {}", master.name, master.modulo);
    }
    if (fits) break;
  }
  for (const CamRefusal& refusal : refused)
    problems.push_back({"cam.refused-by-device"_code, file,
                        refusal.row == 0 ? cam->header : cam->table.places[refusal.row - 1], 1,
                        fmt::format("error {}{}: {}", static_cast<unsigned>(refusal.error), behind,
                                    meaning_of(refusal.error)),
                        refusal.remedy});
  return refused.empty() ? std::move(cam) : std::nullopt;
}

void CamFile::visit(StateArchive& archive) {
  STATE(archive, table.file, table.name, table.id, table.type, table.interpolation, table.values,
        table.places, interpolation, endless, master_modulo, master_modulo_given, slave_modulo, periodic,
        master_unit, slave_unit, table.limits.velocity, table.limits.acceleration, table.limits.jerk,
        table.limits.least, table.limits.most, header);
}

}  // namespace drycut::devices::plcopen
