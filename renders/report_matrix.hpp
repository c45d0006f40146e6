#pragma once
#include <drycut/problem.hpp>

#include <string>
#include <vector>

namespace drycut::renders {

/// What cells of a matrix have in common.
struct MatrixRegion {
  Prose label;  ///< "wrong product, nobody told"
  enum class Kind { good, told, bad, broken, accepted, none } kind = Kind::good;
};

/// Rows of names over columns of names, a coloured cell each. Where a script runs, each cell says what it is
/// and gives a file.
struct ReportMatrix {
  Prose title;
  std::string caption;
  Prose down;    ///< what the rows are: "fault"
  Prose across;  ///< what the columns are: "place in the machine cycle"
  std::vector<std::string> rows;
  std::vector<std::string> columns;  ///< of more than a few only some are written
  std::vector<MatrixRegion> regions;
  std::vector<std::size_t> region;              ///< of each cell, row by row
  std::vector<Prose> headings;                  ///< of what a cell tells
  std::vector<std::vector<std::string>> cells;  ///< likewise; behind it what only the file takes
  std::string file_name;  ///< of a cell's file; {0} stands for the cell's first text, {1} for the next
  std::string file;       ///< what is in it, likewise
};

/// The figure of a page; `number` tells its matrices apart.
std::string matrix_figure(const ReportMatrix& matrix, std::size_t number);
/// What the end of a page needs to make its matrices tell their cells; "" without any.
std::string live_matrices(const std::vector<ReportMatrix>& matrices);

}  // namespace drycut::renders
