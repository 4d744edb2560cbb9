#include "exact_tf/ball_boundary_value_problem.hpp"

#include "exact_tf/ball_enclosure.hpp"

#include <array>

namespace flexarm::exact_tf::ball {

namespace {

using Row = std::array<ComplexBall, 4>;

/// det of the rows a, b, c, d by Laplace's expansion over the first two.
ComplexBall determinant_of_rows(const Row& a, const Row& b, const Row& c, const Row& d) {
  const auto minor = [](const Row& p, const Row& q, std::size_t i, std::size_t j) {
    return p[i] * q[j] - p[j] * q[i];
  };
  return minor(a, b, 0, 1) * minor(c, d, 2, 3) - minor(a, b, 0, 2) * minor(c, d, 1, 3) +
         minor(a, b, 0, 3) * minor(c, d, 1, 2) + minor(a, b, 1, 2) * minor(c, d, 0, 3) -
         minor(a, b, 1, 3) * minor(c, d, 0, 2) + minor(a, b, 2, 3) * minor(c, d, 0, 1);
}

}  // namespace

DimensionlessArm::DimensionlessArm(const arm::LinearArm& arm) {
  const RealBall length(arm.length_m);
  const RealBall density(arm.linear_density_kg_per_m);
  const RealBall rigidity(arm.flexural_rigidity_N_m2);
  const RealBall beam_mass = density * length;
  const RealBall beam_inertia = beam_mass * length * length;
  hub_inertia = RealBall(arm.hub_inertia_kg_m2) / beam_inertia;
  payload_mass = RealBall(arm.payload_mass_kg) / beam_mass;
  payload_inertia = RealBall(arm.payload_tip_inertia_kg_m2) / beam_inertia;
  omega_scale = sqrt(rigidity / density) / (length * length);
}

RootFunction::RootFunction(const DimensionlessArm& arm, LastRow last_row, const RealBall& position)
    : arm_(arm), last_row_(last_row), position_(position) {}

ComplexBall RootFunction::determinant(const ComplexBall& lambda) const {
  const ComplexBall i(RealBall(0), RealBall(1));
  const ComplexBall one(1);
  const Row factor = {i, -i, -one, one};  // of one derivative, over lambda
  const auto values = [&](const ComplexBall& along, const ComplexBall& across) -> Row {
    return {exp(i * along), exp(i * across), exp(-along), exp(-across)};
  };
  const auto differentiated = [&](Row row, int order) {
    for (int k = 0; k < order; ++k) {
      for (std::size_t j = 0; j < 4; ++j) row[j] = row[j] * factor[j];
    }
    return row;
  };
  const auto sum = [](const Row& a, const ComplexBall& weight, const Row& b) {
    Row row;
    for (std::size_t j = 0; j < 4; ++j) row[j] = a[j] + weight * b[j];
    return row;
  };

  const ComplexBall turned = exp(i * lambda);
  const ComplexBall decayed = exp(-lambda);
  const Row root = {one, turned, one, decayed};
  const Row tip = {turned, one, decayed, one};
  const Row root_slope = differentiated(root, 1);
  const ComplexBall lambda3 = lambda * lambda * lambda;

  // y''' + eta z y = 0 and y'' - mu z y' = 0 at the tip.
  // A tip that does not move leaves the payload's mass without force, and the row without a
  // multiple of the last one that would only widen the balls.
  const Row shear = differentiated(tip, 3);
  const Row tip_shear = last_row_ == LastRow::tip_displacement
                            ? shear
                            : sum(shear, ComplexBall(arm_.payload_mass) * lambda, tip);
  const Row tip_moment = sum(differentiated(tip, 2), -ComplexBall(arm_.payload_inertia) * lambda3,
                             differentiated(tip, 1));

  const auto with_last = [&](const Row& last) {
    return determinant_of_rows(root, last, tip_shear, tip_moment);
  };
  switch (last_row_) {
    case LastRow::hub_torque:  // y'' + epsilon z y' = 0 at the root
      return with_last(
          sum(differentiated(root, 2), ComplexBall(arm_.hub_inertia) * lambda3, root_slope));
    case LastRow::hub_angle:
      return with_last(root_slope);
    case LastRow::tip_displacement:
      return with_last(tip);
    case LastRow::tip_deflection:  // y(1) - y'(0)
      return with_last(sum(tip, -lambda, root_slope));
    case LastRow::strain: {  // y''(X)
      const ComplexBall position(position_);
      return with_last(differentiated(values(lambda * position, lambda * (one - position)), 2));
    }
  }
  return one;
}

RealBall RootFunction::on_axis(const RealBall& modulus, const ComplexBall& direction) const {
  const ComplexBall lambda = ComplexBall(modulus) * direction;
  // lambda^(q-1) e^((1 - i) lambda)/i but for its modulus.
  ComplexBall phase = exp(ComplexBall(RealBall(0), lambda.imag() - lambda.real()));
  phase = phase * ComplexBall(RealBall(0), RealBall(-1));
  for (int k = 0; k < power_of_lambda(); ++k) phase = phase * direction;
  if (power_of_lambda() < 0) phase = phase / direction;
  return (determinant(lambda) * phase).real();
}

RealBall RootFunction::on_positive_axis(const RealBall& modulus) const {
  return on_axis(modulus, ComplexBall(1));
}

RealBall RootFunction::on_negative_axis(const RealBall& modulus) const {
  return on_axis(modulus, ComplexBall::unit_at_half_turns(RealBall(1) / RealBall(4)));
}

std::optional<long> RootFunction::count_within(const RealBall& modulus, long& values_left) const {
  const auto change = argument_change([&](const ComplexBall& at) { return determinant(at); },
                                      [&](const RealBall& t) {
                                        return ComplexBall(modulus) *
                                               ComplexBall::unit_at_half_turns(t / RealBall(4));
                                      },
                                      values_left);
  if (!change) return std::nullopt;
  const ComplexBall end =
      ComplexBall(modulus) * ComplexBall::unit_at_half_turns(RealBall(1) / RealBall(4));
  const RealBall rest = end.imag() - end.real() + modulus +
                        RealBall(power_of_lambda()) * RealBall::pi() / RealBall(4);
  // N(conj z) = conj N(z): the lower half of the circle doubles the change.
  const auto zeros = ((*change + rest) / RealBall::pi()).unique_integer();
  if (!zeros) return std::nullopt;
  return *zeros - order_at_zero();
}

int RootFunction::power_of_lambda() const {
  switch (last_row_) {
    case LastRow::hub_torque:
    case LastRow::strain:
      return 1;
    case LastRow::hub_angle:
      return 0;
    case LastRow::tip_displacement:
    case LastRow::tip_deflection:
      return -1;
  }
  return 0;
}

int RootFunction::order_at_zero() const {
  // y = x satisfies the other three conditions at z = 0, and it has no moment and no deflection.
  switch (last_row_) {
    case LastRow::hub_torque:
    case LastRow::strain:
    case LastRow::tip_deflection:
      return 1;
    case LastRow::hub_angle:
    case LastRow::tip_displacement:
      return 0;
  }
  return 0;
}

std::optional<EigenvalueCount> wittrick_williams(const DimensionlessArm& arm,
                                                 const RealBall& lambda) {
  // Hyperbolic functions times 2 e^(-lambda).
  const RealBall decay = exp(-lambda);
  const RealBall sinh_scaled = RealBall(1) - decay * decay;
  const RealBall cosh_scaled = RealBall(1) + decay * decay;
  const RealBall scale = decay + decay;
  RealBall sine;
  RealBall cosine;
  sin_cos(sine, cosine, lambda);

  const RealBall divisor = scale - cosh_scaled * cosine;  // 1 - cosh lambda cos lambda
  const auto half_turns = floor(lambda / RealBall::pi()).unique_integer();
  if (!half_turns || divisor.sign() == 0) return std::nullopt;
  // cosh lambda cos lambda = 1 once in each interval (i pi, (i + 1) pi), i >= 1, and not below pi;
  // 1 - cosh lambda cos lambda has the sign (-1)^(i + 1) before that root and (-1)^i after it,
  // but for i = 0, where it is positive throughout.
  const int sign_before = *half_turns % 2 == 0 ? -1 : 1;
  const long clamped_clamped =
      *half_turns == 0 ? 0 : (divisor.sign() == sign_before ? *half_turns - 1 : *half_turns);

  const RealBall lambda2 = lambda * lambda;
  const RealBall lambda3 = lambda2 * lambda;
  const RealBall lambda4 = lambda2 * lambda2;
  // Forces at the ends for unit displacement or unit slope at one of them.
  const RealBall shear_here = lambda3 * (cosine * sinh_scaled + sine * cosh_scaled) / divisor;
  const RealBall moment_here = lambda * (sine * cosh_scaled - cosine * sinh_scaled) / divisor;
  const RealBall moment_of_displacement_here = lambda2 * sine * sinh_scaled / divisor;
  const RealBall moment_of_displacement_across = lambda2 * (cosh_scaled - cosine * scale) / divisor;
  const RealBall moment_across = lambda * (sinh_scaled - sine * scale) / divisor;

  // Pivots in the order tip displacement, tip slope, root slope.
  const RealBall tip_tip = shear_here - arm.payload_mass * lambda4;
  const RealBall tip_turn = -moment_of_displacement_here;
  const RealBall tip_root = -moment_of_displacement_across;
  const RealBall turn_turn = moment_here - arm.payload_inertia * lambda4;
  const RealBall turn_root = moment_across;
  const RealBall root_root = moment_here - arm.hub_inertia * lambda4;

  if (tip_tip.sign() == 0) return std::nullopt;
  const RealBall second_pivot = turn_turn - tip_turn * tip_turn / tip_tip;
  if (second_pivot.sign() == 0) return std::nullopt;
  const RealBall coupling = turn_root - tip_turn * tip_root / tip_tip;
  const RealBall third_pivot =
      root_root - tip_root * tip_root / tip_tip - coupling * coupling / second_pivot;
  if (third_pivot.sign() == 0) return std::nullopt;

  EigenvalueCount count;
  count.hub_zeros =
      clamped_clamped + (tip_tip.sign() < 0 ? 1 : 0) + (second_pivot.sign() < 0 ? 1 : 0);
  count.poles = count.hub_zeros + (third_pivot.sign() < 0 ? 1 : 0);
  return count;
}

}  // namespace flexarm::exact_tf::ball
