// Every linear effect against 30-digit values, and the laws of matrices and modes with effects on.
#include "fem/fem_arm.hpp"
#include "tests/fem/constants.hpp"
#include "tests/reference/effect_cases.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

// Explicit: GCC 12 does not emit the implicit instantiation beside the precompiled header, and the
// program would not link.
template class Eigen::JacobiSVD<Eigen::MatrixXcd>;

namespace flexarm::fem {
namespace {

using Complex = std::complex<double>;
using reference::EffectCase;

std::vector<arm::Sensor> sensors_of(const EffectCase& reference) {
  std::vector<arm::Sensor> sensors;
  for (const auto& [name, value] : reference.mode_values.front()) {
    sensors.push_back(arm::parse_sensor(name));
  }
  return sensors;
}

void expect_relative(Complex value, Complex exact, double tolerance, const std::string& what) {
  EXPECT_LE(std::abs(value - exact), tolerance * std::abs(exact))
      << what << ": " << value << ", exact " << exact;
}

/// The default mesh, solved by dense algebra, and one of ten times the coordinates, by iterations.
struct Mesh {
  const char* name;
  int elements;
  int degree;
};

FemArm model_of(const arm::Arm& arm, const Mesh& mesh) {
  FemArm::Options options;
  options.mesh.elements = mesh.elements;
  options.degree = mesh.degree;
  return FemArm(arm, options);
}

class EffectReference : public ::testing::TestWithParam<std::tuple<EffectCase, Mesh>> {
 protected:
  /// Some thousand operations; measured at most 7e-13, in mode shapes.
  static constexpr double kRounding = 1e-11;
  const EffectCase& exact = std::get<0>(GetParam());
  const FemArm model = model_of(exact.arm, std::get<1>(GetParam()));
};

TEST_P(EffectReference, PolesAndHubZeros) {
  const arm::PoleSet poles = model.poles(6);
  const arm::ZeroSet zeros = model.zeros({arm::SensorKind::hub_angle}, 6);
  EXPECT_TRUE(poles.summary.converged);
  EXPECT_TRUE(zeros.summary.converged);
  const double lowest = exact.lowest_omega_squared_rad2_per_s2;
  EXPECT_NEAR(poles.lowest_omega_squared_rad2_per_s2, lowest, kRounding * std::abs(lowest));
  for (std::size_t i = 0; i < 6; ++i) {
    expect_relative(poles.omega_rad_per_s[i], exact.pole_rad_per_s[i], kRounding, "pole");
    expect_relative(zeros.s_rad_per_s[i], Complex(0.0, exact.hub_zero_rad_per_s[i]), kRounding,
                    "hub zero");
  }
}

TEST_P(EffectReference, TipZeros) {
  const arm::ZeroSet zeros = model.zeros({arm::SensorKind::tip_acceleration}, 6);
  EXPECT_TRUE(zeros.summary.converged);
  EXPECT_EQ(zeros.count.found, zeros.count.expected);
  std::vector<double> real;
  std::vector<double> imaginary;
  for (const Complex s : zeros.s_rad_per_s) {
    if (s.imag() == 0.0) real.push_back(s.real());
    if (s.real() == 0.0) imaginary.push_back(s.imag());
  }
  ASSERT_FALSE(real.empty());
  for (std::size_t i = 0; i < std::min(real.size(), exact.real_tip_zero_rad_per_s.size()); ++i) {
    expect_relative(real[i], exact.real_tip_zero_rad_per_s[i], kRounding, "real zero");
  }
  const auto& lowest = exact.imaginary_tip_zero_rad_per_s;
  for (std::size_t i = 0; i < std::min(imaginary.size(), lowest.size()); ++i) {
    expect_relative(imaginary[i], lowest[i], kRounding, "imaginary zero");
  }
}

TEST_P(EffectReference, ModesAndResponses) {
  const std::vector<arm::Sensor> sensors = sensors_of(exact);
  const arm::ModalModel modal = model.modal_model(4, sensors, {});
  EXPECT_NEAR(modal.modal_mass_kg_m2, exact.total_inertia_kg_m2,
              kRounding * exact.total_inertia_kg_m2);
  ASSERT_EQ(modal.modes.size(), 5u);
  for (std::size_t i = 0; i < exact.mode_values.size(); ++i) {
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      const std::string name = arm::to_string(sensors[k]);
      expect_relative(modal.modes[i + 1].sensor_values[k], exact.mode_values[i].at(name), kRounding,
                      name);
    }
  }
  for (const reference::EffectResponse& response : exact.responses) {
    for (const auto& [name, value] : response.values) {
      expect_relative(model.transfer_function(arm::parse_sensor(name), response.s_rad_per_s), value,
                      kRounding, name);
    }
  }
}

TEST_P(EffectReference, DampedPolesInTheirOrder) {
  const auto& damped = exact.damped_pole_rad_per_s;
  const arm::DampedPoleSet poles = model.damped_poles(4);
  EXPECT_TRUE(poles.summary.converged);
  ASSERT_EQ(poles.flexible.size(), 4u);
  for (std::size_t i = 0; i < damped.size(); ++i) {
    // A pole that the file has twice says nothing of the next one.
    if (i > 0 && std::ranges::count(damped, damped[i]) > 1 && i + 1 == damped.size()) break;
    expect_relative(poles.flexible[i].first_rad_per_s, damped[i], kRounding, "damped pole");
    expect_relative(poles.flexible[i].second_rad_per_s, std::conj(damped[i]), kRounding,
                    "conjugate");
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, EffectReference,
                         ::testing::Combine(::testing::ValuesIn(reference::effect_cases()),
                                            ::testing::Values(Mesh{"default", 4, 15},
                                                              Mesh{"iterated", 40, 8})),
                         [](const auto& test) {
                           return std::get<0>(test.param).name + "_" + std::get<1>(test.param).name;
                         });

class EffectLaws : public ::testing::TestWithParam<EffectCase> {
 protected:
  const FemArm model = model_of(GetParam().arm, {"small", 3, 6});
  const int n = model.degrees_of_freedom();
  const Eigen::MatrixXd mass{model.mass_kg_m2()};
  const Eigen::MatrixXd stiffness{model.stiffness_N_m()};
  const Eigen::MatrixXd damping{model.damping_N_m_s()};
};

TEST_P(EffectLaws, MatricesAreSymmetricAndEnergiesNotNegative) {
  for (const Eigen::MatrixXd* matrix : {&mass, &stiffness, &damping}) {
    const double largest = matrix->cwiseAbs().maxCoeff();
    EXPECT_LE((*matrix - matrix->transpose()).cwiseAbs().maxCoeff(), 4.0 * kEpsilon * largest);
  }
  EXPECT_EQ(mass.llt().info(), Eigen::Success);
  const auto smallest = [&](const Eigen::MatrixXd& matrix) {
    const Eigen::VectorXd scale =
        (matrix.diagonal().array() > 0.0).select(matrix.diagonal(), 1.0).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues()[0];
  };
  EXPECT_GE(smallest(damping), -n * kEpsilon);
  if (GetParam().lowest_omega_squared_rad2_per_s2 >= 0.0) {
    EXPECT_GE(smallest(stiffness), -n * kEpsilon);
  }
}

TEST_P(EffectLaws, ModalModelIsTheMatricesInTheirModes) {
  // The lowest modes have the largest eigenvalues of M u = (K + shift M) u/(omega^2 + shift).
  constexpr double kTolerance = 1e-8;  // the assembled stiffness' rounding
  const double shift = std::pow(GetParam().pole_rad_per_s.front(), 2);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(mass,
                                                                        stiffness + shift * mass);
  const arm::ModalModel modal = model.modal_model(3, {}, {});
  const double inertia = modal.modal_mass_kg_m2;
  Eigen::MatrixXd phi = dense.eigenvectors().rightCols(4).rowwise().reverse();
  for (int j = 0; j < 4; ++j) {
    phi.col(j) *= std::sqrt(inertia / phi.col(j).dot(mass * phi.col(j)));
    if (phi(0, j) < 0.0) phi.col(j) *= -1.0;
    const arm::Mode& mode = modal.modes[static_cast<std::size_t>(j)];
    EXPECT_NEAR(mode.hub_slope, phi(0, j), kTolerance * phi.row(0).cwiseAbs().maxCoeff());
  }
  const Eigen::MatrixXd expected = phi.transpose() * damping * phi / inertia;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      EXPECT_NEAR(modal.damping_rad_per_s[static_cast<std::size_t>(4 * i + j)], expected(i, j),
                  kTolerance * expected.cwiseAbs().maxCoeff());
    }
  }
}

TEST_P(EffectLaws, AllDampedModesTogetherAreTheTransferFunction) {
  constexpr double kTolerance = 1e-8;
  const std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle},
                                            {arm::SensorKind::tip_displacement}};
  const arm::ModalModel modal = model.modal_model(n, sensors, {});
  const auto count = static_cast<Eigen::Index>(modal.modes.size());
  ASSERT_EQ(count, n);
  const Complex s = Complex(0.1, 0.7) * modal.modes[1].omega_rad_per_s;
  Eigen::MatrixXcd pencil(count, count);
  Eigen::VectorXcd torque(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      pencil(i, j) = s * modal.damping_rad_per_s[static_cast<std::size_t>(i * count + j)];
    }
    const arm::Mode& mode = modal.modes[static_cast<std::size_t>(i)];
    const double squared = i == 0 ? modal.lowest_omega_squared_rad2_per_s2
                                  : mode.omega_rad_per_s * mode.omega_rad_per_s;
    pencil(i, i) += s * s + squared;
    torque[i] = mode.hub_slope / modal.modal_mass_kg_m2;
  }
  const Eigen::VectorXcd q = pencil.partialPivLu().solve(torque);
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    Complex sum = 0.0;
    for (Eigen::Index i = 0; i < count; ++i) {
      sum += modal.modes[static_cast<std::size_t>(i)].sensor_values[k] * q[i];
    }
    expect_relative(model.transfer_function(sensors[k], s), sum, kTolerance,
                    arm::to_string(sensors[k]));
  }
}

TEST_P(EffectLaws, TheQuadraticPencilIsSingularAtDampedPolesAndNoneComesTwice) {
  constexpr double kBeside = 1e-3;
  constexpr double kSmall = 1e-5;  // of the smallest singular value a thousandth of s away
  constexpr double kTwice = 1e-7;
  const double shift = std::pow(GetParam().pole_rad_per_s.front(), 2);
  const Eigen::VectorXd scale = (stiffness + shift * mass).diagonal().cwiseSqrt().cwiseInverse();
  const auto smallest = [&](Complex s) {
    const Eigen::MatrixXcd pencil =
        stiffness.cast<Complex>() + s * damping.cast<Complex>() + s * s * mass.cast<Complex>();
    return (scale.asDiagonal() * pencil * scale.asDiagonal())
        .eval()
        .jacobiSvd()
        .singularValues()[n - 1];
  };
  const arm::DampedPoleSet poles = model.damped_poles(4);
  EXPECT_TRUE(poles.summary.converged);
  std::vector<Complex> all;
  for (const arm::PolePair& pair : poles.flexible) {
    all.push_back(pair.first_rad_per_s);
    all.push_back(pair.second_rad_per_s);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_LE(smallest(all[i]), kSmall * smallest(all[i] * (1.0 + kBeside))) << all[i];
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(std::abs(all[i] - all[j]), kTwice * std::abs(all[i]));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, EffectLaws, ::testing::ValuesIn(reference::effect_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace flexarm::fem
