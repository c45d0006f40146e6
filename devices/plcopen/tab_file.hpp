#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problem.hpp"
#include "base/scanner.hpp"
#include "devices/cam/table.hpp"
#include "devices/plcopen/cam_table.hpp"

// What the readers of cam files share: lines, words with their places, numbers, rows.
namespace drycut::devices::plcopen {

/// line[begin, end) without the blanks around it; the line's `number` is from 1.
Word word_at(std::string_view line, int number, std::size_t begin, std::size_t end);
Words split(std::string_view line, int number, char separator);
/// A finite number, or nullopt.
std::optional<double> number_of(std::string_view text, bool decimal_comma);

/// What the readers do with a text: faults, and rows into a table.
class TableReader : private Complaints {
 public:
  using Complaints::Complaints;

  void fault(Code code, Place place, std::string what, std::string remedy);
  [[nodiscard]] bool sound() const { return faults_ == 0; }
  /// A line of numbers of the table's type.
  void row(McCamTable& table, const Words& words, bool decimal_comma);
  /// Line of the file of each row.
  [[nodiscard]] const std::vector<int>& rows() const { return rows_; }
  /// A whole number in its range, or nullopt with a fault.
  std::optional<int> whole(const Word& word, int min, int max);
  /// A number in its range, or nullopt with a fault.
  std::optional<double> real(const Word& word, double min, double max);

 private:
  void out_of_range(const Word& word, std::string remedy);

  int faults_ = 0;
  std::vector<int> rows_;
};

/// Reads a cam table of the ISG kernel, `*.tab`: header lines `Tablename = ...`, `Tabletype`, `Table-ID`,
/// `Functiontype` (may be missing) and `Lines`, then `Begintable`, one line a row of numbers between blanks,
/// with decimal comma or point, and `EndTable`. `#` begins a comment. Faults go to `problems`; nullopt if
/// there is one.
std::optional<McCamTable> parse_tab(std::string_view text, const std::string& file, Problems& problems);

/// A cam as a file, for use without a controller: the table and the axes that it is meant for.
struct CamFile {
  static constexpr std::string_view kind = "mc_camin";
  McCamTable table;
  Interpolation interpolation = Interpolation::linear;  ///< table_defined: a .tab file that says none
  Endless endless = Endless::no;
  double master_modulo = 3'600'000;  ///< [0.0001 deg or 0.1 um]
  bool master_modulo_given = false;  ///< else it is assumed
  double slave_modulo = 3'600'000;   ///< 0 = linear slave
  bool periodic = true;              ///< StartMode F_PERIODIC
  std::string master_unit = "deg";   ///< or "mm": what the master's increments are 10000 to one of
  std::string slave_unit = "deg";
  int header = 1;  ///< line of the header, or of the first row's columns
  bool operator==(const CamFile&) const = default;
  void visit(StateArchive& archive);
};

/// A key of a cam file's comments, `# key: value`.
struct CamFileKey {
  std::string_view name;
  std::string_view values;
  std::string_view fallback;  ///< where it is not given; "" = nothing stands for it
  std::string_view meaning;
  bool in_csv_only = false;  ///< a .tab file has it in its header
};
std::span<const CamFileKey> cam_file_keys();

/// Reads a cam as CSV or .tab file, without MC_CamIn's own checks. CSV has `# key: value` lines, a header
/// `slave`, `master,slave` or `a0,a1,a2,a3`, then the rows; with `;` between the columns a decimal comma is
/// taken too. `##` begins a remark. In a .tab file all
/// other comments are remarks. Nullopt if there is a fault.
std::optional<CamFile> read_cam(std::string_view text, const std::string& file, Problems& problems);

/// An axis that a cam may follow.
struct MasterTurn {
  std::string name;
  double modulo = 0;
};
/// Reads a cam as CSV; the table is checked as MC_CamIn does, with its error ids, too. One that does not say
/// its master_modulo is judged by the `masters`: it is refused if it goes behind none of them.
std::optional<CamFile> parse_cam_csv(std::string_view text, const std::string& file, Problems& problems,
                                     const std::vector<MasterTurn>& masters = {});

/// One thing that MC_CamIn would refuse.
struct CamRefusal {
  ErrorId error = ErrorId::none;
  std::size_t row = 0;  ///< 1-based; 0 = of the whole table
  std::string remedy;
};
/// All that MC_CamIn would refuse in the file with the axes that it names; a master that does not ascend is
/// told for each row.
std::vector<CamRefusal> refusals(const CamFile& cam);

}  // namespace drycut::devices::plcopen
