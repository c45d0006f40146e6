#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/cam/law.hpp"
#include "devices/plcopen/errors.hpp"

namespace drycut::devices::plcopen {

/// Interpolation between the points of a table: the values of MC_CamIn.TableFctType (004 "table_fkt_type").
enum class Interpolation : std::uint8_t {
  step_direct = 0,
  linear = 1,
  polynom_3 = 2,
  polynom_3_koeff = 3,
  line_poly5 = 4,
  poly5_line = 5,
  table_defined = 6,
};
/// "STEP_DIRECT", ... as the manual spells it.
std::string_view name_of(Interpolation interpolation);
/// By name, any case, or by number; nullopt if `text` is neither.
std::optional<Interpolation> parse_interpolation(std::string_view text);

/// What the lines of a table hold: the file's `Tabletype`.
struct TableType {
  int number = 0;
  int columns = 0;
  bool whole = false;  ///< whole numbers
  double limit = 0;    ///< largest whole number; the smallest is -limit - 1
  std::string_view meaning;
};
/// The types 1..7; nullptr if `number` is none of them. Type 6 is the maker's own and has no columns.
const TableType* table_type(int number);

/// What a slave may do, as far as a file says it, in mm or deg and s; positions in 0.1 um or 0.0001 deg.
struct CamFileLimits {
  std::optional<double> velocity;      ///< maxvel
  std::optional<double> acceleration;  ///< maxacc
  std::optional<double> jerk;          ///< maxjerk
  std::optional<double> least;         ///< minpos
  std::optional<double> most;          ///< maxpos
  bool operator==(const CamFileLimits&) const = default;
};

/// A cam table in memory: a file's contents.
struct McCamTable {
  std::string file;  ///< its file's name, by which MC_CamTableSelect finds it; may be empty
  std::string name;
  std::uint16_t id = 0;                                        ///< 1..65535
  int type = 2;                                                ///< 1..7
  Interpolation interpolation = Interpolation::table_defined;  ///< the header's; table_defined = it has none
  std::vector<double> values;                                  ///< line by line
  std::vector<int> places = {};  ///< of its lines in its file; empty = it came of none
  CamFileLimits limits = {};     ///< for the slave as the table has it; the kernel does not know them

  [[nodiscard]] int columns() const;
  [[nodiscard]] std::size_t lines() const;
  [[nodiscard]] double value(std::size_t line, int column) const {
    return values[line * static_cast<std::size_t>(columns()) + static_cast<std::size_t>(column)];
  }
  bool operator==(const McCamTable&) const = default;
};

/// The interpolation in force for a table: `wanted`, or what its header says if `wanted` is table_defined.
/// Nullopt if the header says none or `wanted` is above 6 (42006).
std::optional<Interpolation> interpolation_of(const McCamTable& table, std::uint32_t wanted);

/// What keeps the table from being run with this interpolation; none if nothing does. `modulo`: the
/// master's turn [0.0001 deg].
ErrorId check(const McCamTable& table, Interpolation interpolation, double modulo);

/// Rows of a table of masters and slaves, from 1, whose master is outside of the turn or not far enough from
/// the row before it; the last one also if the first one follows it too closely, a turn later.
std::vector<std::size_t> disordered_rows(const McCamTable& table, double modulo);

/// The tables of the controller, by id.
class CamTables {
 public:
  /// Adds the table or replaces the one with its id. 240013 if the id is 0, 240011 if its type is
  /// unknown, 42004 if its last line is incomplete.
  ErrorId add(McCamTable table);
  /// Writes one element while the controller runs. 42003, 42007 or 42004 if there is no such element, 44003
  /// if the type cannot hold the value.
  ErrorId write(std::uint16_t id, std::size_t line, int column, double value);
  /// A change of several elements begins or ends; until it ends MC_CamIn refuses the table (60266).
  ErrorId begin_change(std::uint16_t id);
  void end_change(std::uint16_t id);

  [[nodiscard]] const McCamTable* find(std::uint16_t id) const;
  [[nodiscard]] const McCamTable* find_file(std::string_view file) const;
  [[nodiscard]] bool busy(std::uint16_t id) const;
  /// Counts up with every change of the table.
  [[nodiscard]] std::uint64_t revision(std::uint16_t id) const;

  /// What has been written; tables come from their files.
  void visit(StateArchive& archive);

 private:
  struct Entry {
    McCamTable table;
    std::uint64_t revision = 0;
    bool changing = false;

    void visit(StateArchive& archive);
  };
  std::map<std::uint16_t, Entry> entries_;
};

// The cam as a function of the master (004 "table_fkt_type"): segments of polynomials of the fifth degree at
// most, one after the other round the master's turn, exact at the points of the table. Master and slave in
// 0.1 um or 0.0001 deg; velocity, acceleration and jerk are derivatives with respect to the master.

/// Direction in which a cam of an endlessly turning slave passes its turn (StartMode).
enum class Endless : std::int8_t { negative = -1, no = 0, positive = 1 };

/// The whole cam, of polynomials; its pieces' rows are those of the table. The slave's positions are
/// unwrapped: a cam that turns the slave on ends `turns` of its turns from where it began. Where the first
/// point comes after master 0, the end of the last row's piece is the first one, which begins below 0.
struct CamCurve : CamLaw {
  std::int64_t turns = 0;  ///< of the slave in one turn of the master

  void visit(StateArchive& archive);
};

/// The curve of a table that `check` finds sound. `slave_modulo`: 0 for a linear slave, whose cam cannot
/// be endless.
CamCurve curve_of(const McCamTable& table, Interpolation interpolation, double modulo, double slave_modulo,
                  Endless endless);

/// Slave positions of consecutive points, unwrapped: an inner step between two positions inside the turn that
/// goes against the endless direction by more than half a turn is one over the turn's end. The last value
/// is where the cam closes: at the first, or `turns` turns from it in the endless direction.
std::vector<double> unwrapped(const std::vector<double>& positions, double slave_modulo, Endless endless,
                              std::int64_t& turns);

}  // namespace drycut::devices::plcopen
