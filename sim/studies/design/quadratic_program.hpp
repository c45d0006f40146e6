#pragma once
#include <Eigen/Dense>
#include <optional>

namespace drycut::sim::studies {

/// The least of x'Qx/2 + c'x under Ax = b and Gx <= h. Q is positive semidefinite; every x that it leaves
/// free must be held by G.
struct QuadraticProgram {
  Eigen::MatrixXd Q;
  Eigen::VectorXd c;
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
  Eigen::MatrixXd G;
  Eigen::VectorXd h;
};

/// By Mehrotra's predictor and corrector (S. Wright, Primal-Dual Interior-Point Methods, 1997, chapters 10
/// and 14), to 1e-9 of the data's size; nothing if it does not come to that, as where no x keeps the limits.
std::optional<Eigen::VectorXd> solve(const QuadraticProgram& program);

}  // namespace drycut::sim::studies
