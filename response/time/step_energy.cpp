#include "response/time/step_energy.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <boost/math/quadrature/gauss.hpp>
#include <unsupported/Eigen/MatrixFunctions>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// |M| dt of the step that doubling begins with: Gauss' rule of 7 points then errs by 1e-19.
constexpr double kShortPhase = 0.5;

/// Up to this many rows sums are formed in extended precision, some tenths of a second at most: the
/// error of e^(M dt) grows with |M dt|, which may be millions.
constexpr Index kMostExtendedSums = 60;

/// What is integrated over a step: (torque z)(speed z), |viscous z|^2, |material_air z|^2.
struct Integrands {
  Eigen::RowVectorXd torque;
  Eigen::RowVectorXd speed;
  Eigen::MatrixXd viscous;
  Eigen::MatrixXd material_air;
};

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

// Each product of expressions is compiled by itself: of matrices that are formed, the file takes
// the compiler half the time.
template <class Scalar>
Matrix<Scalar> product(const Matrix<Scalar>& a, const Matrix<Scalar>& b) {
  return a * b;
}

template <class Scalar>
Matrix<Scalar> transposed(const Matrix<Scalar>& a) {
  return a.transpose();
}

/// The triangle of [upper; lower]: |R z|^2 = |upper z|^2 + |lower z|^2.
template <class Scalar>
Matrix<Scalar> stacked(const Matrix<Scalar>& upper, const Matrix<Scalar>& lower) {
  Matrix<Scalar> both(upper.rows() + lower.rows(), upper.cols());
  both << upper, lower;
  if (both.rows() <= both.cols()) return both;
  const Eigen::HouseholderQR<Matrix<Scalar>> qr(both);
  return qr.matrixQR().topRows(both.cols()).template triangularView<Eigen::Upper>();
}

struct Integrals {
  Eigen::MatrixXd work;
  Eigen::MatrixXd viscous;
  Eigen::MatrixXd material_air;
};

/// Over a step of `step_s`; `chain` is M dt.
template <class Scalar>
Integrals integrals(const Integrands& integrands, const Eigen::MatrixXd& chain, double step_s) {
  const double phase = chain.cwiseAbs().rowwise().sum().maxCoeff();
  const int doublings = std::max(0, static_cast<int>(std::ceil(std::log2(phase / kShortPhase))));
  const Matrix<Scalar> part =
      chain.cast<Scalar>() * static_cast<Scalar>(std::ldexp(1.0, -doublings));
  const auto length_s = static_cast<Scalar>(std::ldexp(step_s, -doublings));
  const Matrix<Scalar> torque = integrands.torque.cast<Scalar>();
  const Matrix<Scalar> speed = integrands.speed.cast<Scalar>();
  const Matrix<Scalar> viscous_rows = integrands.viscous.cast<Scalar>();
  const Matrix<Scalar> material_rows = integrands.material_air.cast<Scalar>();

  const Index n = chain.rows();
  Matrix<Scalar> work = Matrix<Scalar>::Zero(n, n);
  Matrix<Scalar> viscous(0, n);
  Matrix<Scalar> material_air(0, n);
  using Rule = boost::math::quadrature::gauss<Scalar, 7>;
  const auto add_point = [&](Scalar r, Scalar rule_weight) {
    const Scalar weight = rule_weight * length_s / 2;
    const Matrix<Scalar> there = Matrix<Scalar>(part * r).exp();
    using std::sqrt;
    work += weight * product(transposed(product(torque, there)), product(speed, there));
    viscous = stacked<Scalar>(viscous, sqrt(weight) * product(viscous_rows, there));
    material_air = stacked<Scalar>(material_air, sqrt(weight) * product(material_rows, there));
  };
  const Scalar half = Scalar(1) / 2;
  add_point(half, Rule::weights()[0]);
  for (std::size_t k = 1; k < Rule::abscissa().size(); ++k) {
    add_point(half * (1 - Rule::abscissa()[k]), Rule::weights()[k]);
    add_point(half * (1 + Rule::abscissa()[k]), Rule::weights()[k]);
  }
  Matrix<Scalar> over = part.exp();
  for (int i = 0; i < doublings; ++i) {
    work += product(transposed(over), product(work, over));
    viscous = stacked<Scalar>(viscous, product(viscous, over));
    material_air = stacked<Scalar>(material_air, product(material_air, over));
    over = product(over, over);
  }
  return {work.template cast<double>(), viscous.template cast<double>(),
          material_air.template cast<double>()};
}

/// C with C^T C = `form`, but for eigenvalues below 0.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& form) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(form);
  return eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace

StepEnergy::StepEnergy(const ModalDynamics& arm, Hub hub, double hub_viscous_friction_N_m_s_per_rad,
                       double step_s) {
  const LinearSystem& system = hub == Hub::held ? arm.held : arm.turning;
  const Index size = arm.size();
  const Index u = size;
  const Index change = size + 1;
  const Index f = size + 2;
  const Index smooth = size + 3;
  const Index all = size + 4;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(all, all);
  chain.topLeftCorner(size, size) = system.a * step_s;
  chain.col(u).head(size) = system.actuator * step_s;
  if (system.actuator_rate.size() > 0) chain.col(change).head(size) = system.actuator_rate;
  chain.col(f).head(size) = system.force * step_s;
  chain(u, change) = 1.0;

  const Index n = arm.modes;
  Integrands integrands;
  integrands.torque.setZero(all);
  integrands.torque.head(size) = arm.hub_torque.state;
  integrands.torque(u) = arm.hub_torque.actuator;
  integrands.torque(smooth) = 1.0;
  integrands.speed.setZero(all);
  if (hub == Hub::turning) integrands.speed.segment(n, n) = arm.hub_slope.transpose();
  integrands.viscous = std::sqrt(hub_viscous_friction_N_m_s_per_rad) * integrands.speed;
  integrands.material_air.setZero(n, all);
  integrands.material_air.middleCols(n, n) =
      root_of(arm.modal_mass_kg_m2 * arm.damping -
              hub_viscous_friction_N_m_s_per_rad * arm.hub_slope * arm.hub_slope.transpose());

  Integrals made = chain.rows() <= kMostExtendedSums
                       ? integrals<long double>(integrands, chain, step_s)
                       : integrals<double>(integrands, chain, step_s);
  work_ = std::move(made.work);
  viscous_ = std::move(made.viscous);
  material_air_ = std::move(made.material_air);
}

StepEnergy::Amounts StepEnergy::operator()(const Eigen::VectorXd& x, const Torques& torques) const {
  Eigen::VectorXd z(work_.rows());
  z << x, torques.actuator_begin, torques.actuator_end - torques.actuator_begin, torques.added,
      torques.added_smooth;
  return {z.dot(work_ * z), (viscous_ * z).squaredNorm(), (material_air_ * z).squaredNorm()};
}

}  // namespace flexarm::response
