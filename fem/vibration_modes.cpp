#include "fem/vibration_modes.hpp"

#include "fem/slow_modes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <Spectra/SymGEigsShiftSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace flexarm::fem {

namespace {

/// Up to this many coordinates a Krylov space of 20 is nearly all there is.
constexpr int kDenseSize = 24;

/// Spectra's (A - sigma B)^-1, fixed at sigma = 0, on what is M-orthogonal to `known` modes.
class ShiftSolveAtZero {
 public:
  using Scalar = double;

  ShiftSolveAtZero(const Discretisation& model, const FlexibleSolve& solve,
                   const Eigen::MatrixXd& known)
      : solve_(solve), known_(known), momenta_(model.mass() * known) {}

  Eigen::Index rows() const { return known_.rows(); }
  Eigen::Index cols() const { return known_.rows(); }
  void set_shift(double) {}
  /// Projected on both sides: the loads lose what excites a known mode, the response what rounding
  /// brings back.
  Eigen::VectorXd operator()(Eigen::VectorXd f) const {
    f -= momenta_ * (known_.transpose() * f);
    Eigen::VectorXd u = solve_(f).u;
    u -= known_ * (momenta_.transpose() * u);
    ++applications_;
    return u;
  }
  void perform_op(const double* f, double* u) const {
    Eigen::VectorXd::MapType(u, rows()) = (*this)(Eigen::VectorXd::ConstMapType(f, rows()));
  }
  int applications() const { return applications_; }

 private:
  const FlexibleSolve& solve_;
  const Eigen::MatrixXd& known_;
  Eigen::MatrixXd momenta_;
  mutable int applications_ = 0;
};

class MassProduct {
 public:
  using Scalar = double;

  MassProduct(const Discretisation& model, HubSupport support) : model_(model), support_(support) {}

  Eigen::Index rows() const { return model_.size(); }
  Eigen::Index cols() const { return model_.size(); }
  void perform_op(const double* x, double* y) const {
    Eigen::VectorXd::MapType result(y, rows());
    result = model_.mass() * Eigen::VectorXd::ConstMapType(x, rows());
    if (support_ == HubSupport::clamped) result[0] = x[0];
  }

 private:
  const Discretisation& model_;
  HubSupport support_;
};

std::runtime_error eigensolver_failure(const char* method, const Discretisation& model,
                                       HubSupport support, int count) {
  return std::runtime_error(
      fmt::format("fem: {} failed for the {} lowest modes with the hub {} of {}", method, count,
                  support == HubSupport::clamped ? "clamped" : "free", describe(model)));
}

/// M = L L^T, the free coordinates alone. A sheared element with next to no rotary inertia has
/// motions without kinetic energy: then M is semidefinite and L one of its square roots.
class MassRoot {
 public:
  MassRoot(const Discretisation& model, const FlexibleSolve& solve, int free_size)
      : model_(model),
        solve_(solve),
        cholesky_(Eigen::MatrixXd(model.mass()).bottomRightCorner(free_size, free_size)) {
    if (is_definite()) {
      lower_ = cholesky_.matrixL();
      return;
    }
    const Eigen::LDLT<Eigen::MatrixXd> pivoted(
        Eigen::MatrixXd(model.mass()).bottomRightCorner(free_size, free_size));
    const Eigen::MatrixXd unit = pivoted.matrixL();
    lower_ = pivoted.transpositionsP().transpose() * unit;
    lower_ *= pivoted.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  }

  const Eigen::MatrixXd& lower() const { return lower_; }
  /// What the loads in the columns bring about.
  Eigen::MatrixXd responses(const Eigen::MatrixXd& loads) const {
    Eigen::MatrixXd u(model_.size(), loads.cols());
    Eigen::VectorXd load = Eigen::VectorXd::Zero(model_.size());
    for (Eigen::Index j = 0; j < loads.cols(); ++j) {
      load.tail(loads.rows()) = loads.col(j);
      u.col(j) = solve_(load).u;
    }
    return u;
  }
  /// The modes u with L^T u = `v`; up to their sizes, from their responses to L v, where L cannot
  /// be inverted.
  Eigen::MatrixXd shapes(const Eigen::MatrixXd& v) const {
    if (!is_definite()) return responses(lower_ * v);
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(model_.size(), v.cols());
    u.bottomRows(v.rows()) = cholesky_.matrixU().solve(v);
    return u;
  }

 private:
  bool is_definite() const { return cholesky_.info() == Eigen::Success; }

  const Discretisation& model_;
  const FlexibleSolve& solve_;
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
  Eigen::MatrixXd lower_;
};

/// The modes from right singular vectors of D^-1/2 B^-T P L, M = L L^T; P takes the rigid
/// acceleration out of the loads. Of a shifted problem from eigenvectors of L^T (K + shift M)^-1 L.
Eigen::MatrixXd dense_shapes(const Discretisation& model, HubSupport support,
                             const FlexibleSolve& solve, int count) {
  const int held = support == HubSupport::clamped ? 1 : 0;
  const int free_size = model.size() - held;
  const MassRoot root_of_mass(model, solve, free_size);
  const Eigen::MatrixXd& lower = root_of_mass.lower();
  if (solve.shift() > 0.0) {
    const Eigen::MatrixXd product =
        lower.transpose() * root_of_mass.responses(lower).bottomRows(free_size);
    const Eigen::MatrixXd symmetric = (product + product.transpose()) / 2.0;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric);
    if (eigen.info() != Eigen::Success) {
      throw eigensolver_failure("QR iteration", model, support, count);
    }
    return root_of_mass.shapes(eigen.eigenvectors().rightCols(count).rowwise().reverse());
  }
  const Eigen::VectorXd root = solve.flexibility().natural_stiffness().cwiseSqrt();
  Eigen::MatrixXd strains(model.clamped_size(), free_size);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model.size());
  for (int j = 0; j < free_size; ++j) {
    load.tail(free_size) = lower.col(j);
    const Eigen::VectorXd d =
        solve.flexibility().deformations(solve.self_equilibrated(load).tail(model.clamped_size()));
    strains.col(j) = d.cwiseProduct(root);
  }
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(strains, Eigen::ComputeThinV);
  if (svd.info() != Eigen::Success) {
    throw eigensolver_failure("singular value decomposition", model, support, count);
  }
  return root_of_mass.shapes(svd.matrixV().leftCols(count));
}

/// Lanczos: `count` modes M-orthogonal to the `known` ones.
Eigen::MatrixXd lanczos_shapes(const Discretisation& model, HubSupport support,
                               const FlexibleSolve& solve, const Eigen::MatrixXd& known, int count,
                               double tolerance, int& iterations) {
  constexpr Eigen::Index kMaximumRestarts = 1000;
  ShiftSolveAtZero shift_solve(model, solve, known);
  MassProduct mass(model, support);
  // Spectra's own recommendation for the dimension of the Krylov space.
  const int krylov = std::min(model.size(), std::max(2 * count + 1, 20));
  Spectra::SymGEigsShiftSolver<ShiftSolveAtZero, MassProduct, Spectra::GEigsMode::ShiftInvert>
      solver(shift_solve, mass, count, krylov, 0.0);
  // A start in the flexible subspace with a part in every mode.
  const Eigen::VectorXd loads = Eigen::VectorXd::LinSpaced(model.size(), 1.0, 7919.0).array().sin();
  const Eigen::VectorXd start = shift_solve(loads);
  try {
    solver.init(start.data());
    const Eigen::Index found = solver.compute(Spectra::SortRule::LargestMagn, kMaximumRestarts,
                                              tolerance, Spectra::SortRule::SmallestAlge);
    if (found < count) throw std::runtime_error("no convergence");
  } catch (const std::runtime_error&) {
    throw eigensolver_failure("Lanczos iteration", model, support, count);
  }
  iterations = shift_solve.applications();
  return solver.eigenvectors(count);
}

Eigen::MatrixXd iterated_shapes(const Discretisation& model, HubSupport support,
                                const FlexibleSolve& solve, int count, double tolerance,
                                int& iterations) {
  const Eigen::MatrixXd known = slow_modes(model, solve);
  const int rest = count - static_cast<int>(known.cols());
  if (rest <= 0) return known.leftCols(count);
  const Eigen::MatrixXd others =
      lanczos_shapes(model, support, solve, known, rest, tolerance, iterations);
  Eigen::MatrixXd shapes(model.size(), count);
  shapes << known, others;
  return shapes;
}

/// Inverse iteration, each mode kept M-orthogonal to those below it: two steps, and more while they
/// still move the eigenvalue and move it less and less. Lanczos vectors keep few digits
/// beside a mode that is far slower, but not so slow that it is taken out before (slow_modes).
///
/// A step multiplies what is left of a mode i below by (omega_j/omega_i)^2, which is 10^19 beside a
/// heavy hub behind a compliant drive. What rounding leaves of mode i in the projected response
/// would then grow from step to step. So the loads are projected as well, before the solution.
void refine(const Discretisation& model, const FlexibleSolve& solve, const Eigen::MatrixXd& raw,
            VibrationModes& modes) {
  constexpr int kSteps = 2;
  constexpr int kMostSteps = 40;
  constexpr double kStill = 1e-13;
  const Eigen::Index count = raw.cols();
  modes.omega_squared.resize(count);
  modes.shapes.resize(model.size(), count);
  modes.deformations.resize(model.clamped_size(), count);
  Eigen::MatrixXd momenta(model.size(), count);
  for (Eigen::Index j = 0; j < count; ++j) {
    Eigen::VectorXd u = raw.col(j);
    u /= std::sqrt(u.dot(model.mass() * u));
    double omega_squared = 0.0;
    double change = std::numeric_limits<double>::infinity();
    double previous_change = change;
    const auto is_moving = [&] { return change > kStill && change < previous_change; };
    for (int step = 0; step < kSteps || (step < kMostSteps && is_moving()); ++step) {
      previous_change = change;
      Eigen::VectorXd loads = model.mass() * u;
      const Eigen::VectorXd exciting = modes.shapes.leftCols(j).transpose() * loads;
      loads -= momenta.leftCols(j) * exciting;
      Deformed next = solve(loads);
      const Eigen::VectorXd below = momenta.leftCols(j).transpose() * next.u;
      next.u -= modes.shapes.leftCols(j) * below;
      next.d -= modes.deformations.leftCols(j) * below;
      const Eigen::VectorXd momentum = model.mass() * next.u;
      const double norm = std::sqrt(next.u.dot(momentum));
      const double quotient =
          model.stiffness_products<double>(next.u, next.d)(0, 0) / (norm * norm);
      change = std::abs(quotient - omega_squared) / std::abs(quotient + solve.shift());
      omega_squared = quotient;
      u = next.u / norm;
      modes.shapes.col(j) = u;
      momenta.col(j) = momentum / norm;
      modes.deformations.col(j) = next.d / norm;
    }
    modes.omega_squared[j] = omega_squared;
    modes.largest_change = std::max(modes.largest_change, change);
  }
}

/// Takes the lowest mode of a held hub from the others.
void part_lowest(VibrationModes& modes) {
  const Eigen::Index flexible = modes.omega_squared.size() - 1;
  modes.lowest_omega_squared = modes.omega_squared[0];
  modes.lowest = {modes.shapes.col(0), modes.deformations.col(0)};
  modes.omega_squared = modes.omega_squared.tail(flexible).eval();
  modes.shapes = modes.shapes.rightCols(flexible).eval();
  modes.deformations = modes.deformations.rightCols(flexible).eval();
}

}  // namespace

VibrationModes vibration_modes(const Discretisation& discretisation, HubSupport support, int count,
                               double tolerance, Eigensolver eigensolver) {
  VibrationModes modes;
  const FlexibleSolve solve(discretisation, support);
  const bool lowest_beside = support == HubSupport::free && !solve.leaves_out_rigid_rotation();
  const int available = discretisation.clamped_size() + (lowest_beside ? 1 : 0);
  count = std::min(count + (lowest_beside ? 1 : 0), available);
  modes.dense = discretisation.size() <= kDenseSize || 4 * count > available;
  if (eigensolver != Eigensolver::by_size) modes.dense = eigensolver == Eigensolver::dense;
  const Eigen::MatrixXd raw = modes.dense ? dense_shapes(discretisation, support, solve, count)
                                          : iterated_shapes(discretisation, support, solve, count,
                                                            tolerance, modes.iterations);
  refine(discretisation, solve, raw, modes);
  // A mode that the last step of refinement still moved was not one.
  constexpr double kSettled = 1e-8;
  modes.converged = modes.largest_change <= std::max(kSettled, tolerance);
  if (lowest_beside) {
    part_lowest(modes);
  } else if (support == HubSupport::free) {
    modes.lowest = {discretisation.rigid_rotation() / std::sqrt(discretisation.total_inertia()),
                    Eigen::VectorXd::Zero(discretisation.clamped_size())};
  }
  return modes;
}

int eigenvalues_below(const Discretisation& discretisation, HubSupport support,
                      double omega_squared) {
  // Callers count at 1 + 1e-6 times an eigenvalue.
  constexpr double kRoundingAllowed = 1e-7;
  const double shortest =
      *std::min_element(discretisation.lengths().begin(), discretisation.lengths().end());
  const double rounding =
      12.0 * std::numeric_limits<double>::epsilon() / std::pow(shortest, 4) / omega_squared;
  if (rounding > kRoundingAllowed) return -1;
  const Eigen::SparseMatrix<double> shifted =
      discretisation.stiffness() - omega_squared * discretisation.mass();
  const int size =
      support == HubSupport::clamped ? discretisation.clamped_size() : discretisation.size();
  const Eigen::SparseMatrix<double> block = shifted.bottomRightCorner(size, size);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower,
                              Eigen::NaturalOrdering<int>>
      factor(block);
  if (factor.info() != Eigen::Success) return -1;
  return static_cast<int>((factor.vectorD().array() < 0.0).count());
}

}  // namespace flexarm::fem
