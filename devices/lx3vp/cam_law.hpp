#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "devices/lx3vp/ecamtbx.hpp"
#include "devices/lx3vp/registers.hpp"

namespace drycut::devices::lx3vp {

/// The rows in the block at D`block`, as many as its word 38 says.
std::vector<CamTableRow> read_rows(const Registers& registers, int block);

/// A straight piece between each two rows, which is how the device plays them; none if they do not ascend.
CamLaw straight_law(const std::vector<CamTableRow>& rows);

/// Integers of 128 bit: positions of the cam are fractions whose terms do not fit 64.
__extension__ using Wide = __int128;

/// A ratio of the block, 1..65535 each.
struct Zoom {
  std::uint16_t numerator = 1;
  std::uint16_t denominator = 1;
  void visit(StateArchive& archive);
};

/// The cam's law in whole numbers: straight lines between the rows of a table, repeated from cycle to cycle,
/// with the zooms of master and slave. There is one rounding, of the pulses at the end, so that nothing
/// drifts however long the cam runs.
class RowLaw {
 public:
  using Row = CamTableRow;
  RowLaw() = default;
  /// At least two rows; masters not negative and ascending.
  RowLaw(std::vector<Row> rows, Zoom master, Zoom slave);

  /// Where the master is: cycle `cycle` and, in it, `part` / master zoom's denominator table units after the
  /// first row. `part` is 0..length(); length() itself is the end of a cycle that goes no further.
  struct Place {
    std::int64_t cycle = 0;
    std::int64_t part = 0;
    bool operator==(const Place&) const = default;
    void visit(StateArchive& archive);
  };
  /// Of a master that has come `counts` from table position `first` (0 = the first row).
  [[nodiscard]] Place place(std::int64_t counts, std::int64_t first = 0) const;
  /// Length of a cycle, in units of Place::part.
  [[nodiscard]] std::int64_t length() const { return length_; }

  /// Where the slave is then.
  struct Slave {
    std::int64_t pulses = 0;    ///< from the start of cycle 0, to the nearest, halves upwards
    std::int64_t before = 0;    ///< of them, up to the start of its cycle
    std::int64_t position = 0;  ///< in table units, to the nearest
    void visit(StateArchive& archive);
  };
  [[nodiscard]] Slave slave(const Place& place) const;
  [[nodiscard]] std::int64_t pulses(const Place& place) const { return slave(place).pulses; }
  /// Master position in table units, downwards to a whole one.
  [[nodiscard]] std::int64_t master_position(const Place& place) const;
  [[nodiscard]] std::int64_t slave_position(const Place& place) const { return slave(place).position; }

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] const Zoom& master_zoom() const { return master_; }
  [[nodiscard]] const Zoom& slave_zoom() const { return slave_; }

  void visit(StateArchive& archive);

 private:
  void prepare();
  // Where a row is, in units of Place::part.
  [[nodiscard]] std::int64_t begin_of(const Row& row) const {
    return (std::int64_t{row.master} - rows_.front().master) * master_.denominator;
  }
  /// From one row to the next, with what each tick asks of it.
  struct Piece {
    std::size_t row = 0;  ///< the one at its end
    std::int64_t begin = 0;
    std::int64_t end = 0;   ///< begin: none has been looked for
    std::int64_t base = 0;  ///< the slave at its begin, from the first row
    std::int64_t rise = 0;
  };
  const Piece& piece_at(std::int64_t part) const;
  void look_for_piece(std::int64_t part) const;
  template <typename Integer>
  [[nodiscard]] Slave slave_in(const Place& place) const;

  std::vector<Row> rows_;
  Zoom master_;
  Zoom slave_;
  std::int64_t narrow_cycles_ = 0;  ///< up to this one all products fit 64 bits
  std::int64_t length_ = 0;
  mutable Piece piece_;  ///< the one found last: where the next look begins
};

}  // namespace drycut::devices::lx3vp
