#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/table.hpp"
#include "sim/studies/cluster/workers.hpp"
#include "sim/studies/faults/accept.hpp"
#include "sim/studies/faults/bench.hpp"
#include "sim/studies/faults/question.hpp"

namespace drycut::sim::studies {

/// What came of all faults at all moments: a row of cells a fault, in the order of the question.
struct FaultMatrix {
  std::vector<FaultCell> cells;
  std::vector<std::optional<std::size_t>> accepted;  ///< of each the entry that accepts it
  std::size_t simulated = 0;                         ///< now; the others were in the file
  std::vector<std::string> lost;                     ///< why each that was lost was

  [[nodiscard]] const FaultCell& at(const FaultQuestion& question, std::size_t fault,
                                    std::size_t when) const {
    return cells[fault * question.when.size() + when];
  }
  /// Red or damage, and nobody has accepted it.
  [[nodiscard]] bool fails(std::size_t cell) const { return cells[cell].is_red() && !accepted[cell]; }
};

/// Tries every fault at every moment; what is in `file` is not tried again. `progress` is told how many of
/// how many cells are done. Throws std::runtime_error if the file cannot be written.
FaultMatrix try_faults(const FaultQuestion& question, const std::filesystem::path& file,
                       const cluster::Workers& workers,
                       const std::function<void(std::size_t done, std::size_t of)>& progress);

/// Says which cells are accepted. An entry that matches none is a finding.
std::vector<Finding> accept_cells(const FaultQuestion& question, const std::vector<AcceptedCells>& entries,
                                  FaultMatrix& matrix);

/// faults.csv: a row a cell.
Table faults_table(const FaultQuestion& question, const std::vector<AcceptedCells>& entries,
                   const FaultMatrix& matrix);

/// Cells of one fault with one end, one moment after the other: "20..45 %, at knife.cut".
struct FaultStretch {
  FaultCell::Kind kind = FaultCell::Kind::unharmed;
  bool accepted = false;
  std::string when;
  std::size_t first = 0;  ///< the first of its cells, by moment
  int count = 0;
  int parts = 1;  ///< of `when`
};
/// What came of one fault, in the order of its moments.
std::vector<FaultStretch> stretches_of(const FaultQuestion& question, const FaultMatrix& matrix,
                                       std::size_t fault);
/// "wrong product, nobody told", as people are told.
Prose text_of(FaultCell::Kind kind);
/// "told by Knife errorstop after 0.12 s", "cut length fails after 0.7 s; nobody told".
std::string text_of(const FaultCell& cell);

/// Answers the cells of a question elsewhere: JSON in, the cell as JSON out. Throws std::runtime_error if the
/// question is none.
std::function<std::string(const std::string& ask)> fault_answerer(const std::string& question);

}  // namespace drycut::sim::studies
