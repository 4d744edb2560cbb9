#include "exact_tf/certificate.hpp"

#include "exact_tf/analytic_zeros.hpp"
#include "exact_tf/ball_boundary_value_problem.hpp"
#include "exact_tf/ball_enclosure.hpp"
#include "exact_tf/plain_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>

namespace flexarm::exact_tf {

namespace {

using ball::ComplexBall;
using ball::DimensionlessArm;
using ball::LastRow;
using ball::Precision;
using ball::RealBall;
using ball::RootFunction;

constexpr const char* kCertificate = "the exact roots' certificate";

/// Half-width of the enclosures in ulp of |lambda|.
const double kReachUlp = std::ldexp(1.0, -12);

struct Enclosed {
  ZeroLocus locus;
  RealBall modulus;
  ComplexBall lambda;
};

double ulp_of(double modulus) {
  return std::nextafter(modulus, std::numeric_limits<double>::infinity()) - modulus;
}

/// Runs `attempt` at rising precision until it returns a value; notes the highest precision used.
template <class Attempt>
auto at_rising_precision(const CertificateOptions& options, long& highest, Attempt attempt)
    -> decltype(attempt()) {
  for (long bits = options.precision_bits; bits <= options.max_precision_bits; bits *= 2) {
    const Precision scope(bits);
    highest = std::max(highest, bits);
    if (auto result = attempt()) return result;
  }
  return std::nullopt;
}

/// One root problem of one arm, rebuilt at whatever precision is set.
class Problem {
 public:
  Problem(const arm::Arm& arm, LastRow last_row, double position_m = 0.0)
      : arm_(plain(arm)), last_row_(last_row), position_m_(position_m) {}

  const arm::LinearArm& arm() const { return arm_; }

  RootFunction function() const {
    return RootFunction(DimensionlessArm(arm_), last_row_,
                        RealBall(position_m_) / RealBall(arm_.length_m));
  }

 private:
  static arm::LinearArm plain(const arm::Arm& arm) {
    arm::require_valid(arm);
    arm::require_honoured(arm.effects, kCertificate, arm::kLinearArmPorts);
    require_plain(arm, kCertificate);
    return linear_arm(arm);
  }

  arm::LinearArm arm_;
  LastRow last_row_;
  double position_m_;
};

using GivenLambda = std::function<ComplexBall()>;

/// Encloses the root near `given` and says how far from it that is.
std::optional<Enclosed> enclose(const Problem& problem, ZeroLocus locus, const GivenLambda& given,
                                const CertificateOptions& options, Certificate& certificate,
                                RootEnclosure& report) {
  const auto attempt = [&]() -> std::optional<Enclosed> {
    const RootFunction function = problem.function();
    const ComplexBall start = given();
    const RealBall start_modulus = abs(start);
    const double reach = kReachUlp * ulp_of(start_modulus.nearest_double());
    Enclosed result{locus, {}, {}};
    if (locus == ZeroLocus::off_axis) {
      const auto lambda = ball::enclose_complex_zero(
          [&](const ComplexBall& at) { return function.determinant(at); }, start, reach);
      // Off both axes, so that the zero and its conjugate in z are two.
      if (!lambda || lambda->imag().sign() <= 0 || (lambda->real() - lambda->imag()).sign() <= 0) {
        return std::nullopt;
      }
      result.lambda = *lambda;
      result.modulus = abs(*lambda);
    } else {
      const bool positive = locus == ZeroLocus::positive_axis;
      const auto modulus = ball::enclose_sign_change(
          [&](const RealBall& at) {
            return positive ? function.on_positive_axis(at) : function.on_negative_axis(at);
          },
          start_modulus, reach);
      if (!modulus) return std::nullopt;
      result.modulus = *modulus;
      result.lambda = positive ? ComplexBall(*modulus)
                               : ComplexBall(*modulus) *
                                     ComplexBall::unit_at_half_turns(RealBall(1) / RealBall(4));
    }
    return result;
  };
  auto enclosed = at_rising_precision(options, certificate.precision_bits, attempt);
  if (!enclosed) {
    report.distance_ulp = std::numeric_limits<double>::infinity();
    return std::nullopt;
  }
  const Precision scope(options.precision_bits);
  const std::complex<double> midpoint = enclosed->lambda.nearest_double();
  const ComplexBall exact_midpoint(RealBall(midpoint.real()), RealBall(midpoint.imag()));
  report.enclosed = true;
  report.lambda = midpoint;
  report.radius = abs(enclosed->lambda - exact_midpoint).upper_bound();
  report.distance_ulp =
      abs(enclosed->lambda - given()).upper_bound() / ulp_of(enclosed->modulus.nearest_double());
  return enclosed;
}

/// The reason why the enclosures are not the ascending, disjoint neighbours of what was given.
std::string fault_of(const std::vector<std::optional<Enclosed>>& enclosed,
                     const Certificate& certificate, const CertificateOptions& options) {
  for (std::size_t i = 0; i < enclosed.size(); ++i) {
    if (!enclosed[i]) return fmt::format("root {}: no certified root nearby", i + 1);
    const double distance = certificate.roots[i].distance_ulp;
    if (!(distance <= options.max_distance_ulp)) {
      return fmt::format("root {} differs by {:.3g} ulp from the enclosed root; allowed: {:.3g}",
                         i + 1, distance, options.max_distance_ulp);
    }
  }
  for (std::size_t i = 0; i < enclosed.size(); ++i) {
    if (i > 0 && enclosed[i]->modulus.is_below(enclosed[i - 1]->modulus)) {
      return fmt::format("roots {} and {} are not in ascending order", i, i + 1);
    }
  }
  // On an axis each enclosure must end below the next, which keeps all of them apart; off the axes
  // there are few, and each is compared with each.
  std::map<ZeroLocus, std::vector<std::size_t>> earlier;
  for (std::size_t i = 0; i < enclosed.size(); ++i) {
    auto& others = earlier[enclosed[i]->locus];
    for (auto other = others.rbegin(); other != others.rend(); ++other) {
      const bool on_axis = enclosed[i]->locus != ZeroLocus::off_axis;
      const bool apart = on_axis ? enclosed[*other]->modulus.is_below(enclosed[i]->modulus)
                                 : !enclosed[*other]->lambda.overlaps(enclosed[i]->lambda);
      if (!apart) return fmt::format("roots {} and {} share an enclosure", *other + 1, i + 1);
      if (on_axis) break;
    }
    others.push_back(i);
  }
  return {};
}

/// An exact modulus just above every enclosure.
RealBall beyond(const std::vector<std::optional<Enclosed>>& enclosed) {
  RealBall largest;
  for (const auto& root : enclosed) {
    const RealBall end = root->modulus.upper_end();
    if (largest.is_below(end)) largest = end;
  }
  return largest;
}

/// Roots counted in z with conjugates, as the argument principle does.
long weight_of(const std::vector<std::optional<Enclosed>>& enclosed) {
  long weight = 0;
  for (const auto& root : enclosed) weight += root->locus == ZeroLocus::off_axis ? 2 : 1;
  return weight;
}

/// Fills in everything: `count` is asked for the number of roots up to a modulus, and may decline
/// at the precision set.
Certificate certify(const Problem& problem, const std::vector<ZeroLocus>& loci,
                    const std::vector<GivenLambda>& given, const CertificateOptions& options,
                    const std::function<std::optional<long>(const RealBall&)>& count) {
  Certificate certificate;
  certificate.given = static_cast<int>(given.size());
  certificate.roots.resize(given.size());
  std::vector<std::optional<Enclosed>> enclosed(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    enclosed[i] = enclose(problem, loci[i], given[i], options, certificate, certificate.roots[i]);
    certificate.largest_distance_ulp =
        std::max(certificate.largest_distance_ulp, certificate.roots[i].distance_ulp);
  }
  certificate.failure = fault_of(enclosed, certificate, options);
  if (std::any_of(enclosed.begin(), enclosed.end(), [](const auto& root) { return !root; })) {
    return certificate;
  }

  const auto counted = at_rising_precision(options, certificate.precision_bits,
                                           [&] { return count(beyond(enclosed)); });
  if (!counted) {
    if (certificate.failure.empty()) {
      certificate.failure = fmt::format("root count not certified with {} values at up to {} bits",
                                        options.max_function_values, options.max_precision_bits);
    }
    return certificate;
  }
  certificate.counted = *counted;
  if (certificate.failure.empty() && *counted != weight_of(enclosed)) {
    certificate.failure = fmt::format("{} roots up to the last one given, but {} in the list",
                                      *counted, weight_of(enclosed));
  }
  certificate.proved = certificate.failure.empty();
  return certificate;
}

Certificate certify_self_adjoint(const arm::Arm& arm, LastRow last_row,
                                 std::span<const double> lambdas,
                                 const CertificateOptions& options) {
  const Problem problem(arm, last_row);
  std::vector<GivenLambda> given;
  given.reserve(lambdas.size());
  for (const double lambda : lambdas) {
    given.push_back([lambda] { return ComplexBall(RealBall(lambda)); });
  }
  const auto count = [&](const RealBall& beyond) -> std::optional<long> {
    const auto found = ball::wittrick_williams(DimensionlessArm(problem.arm()), beyond);
    if (!found) return std::nullopt;
    constexpr long kRigidBodyModes = 1;
    return last_row == LastRow::hub_torque ? found->poles - kRigidBodyModes : found->hub_zeros;
  };
  Certificate certificate = certify(problem, std::vector(lambdas.size(), ZeroLocus::positive_axis),
                                    given, options, count);
  certificate.method = "change of sign and Wittrick-Williams count in ball arithmetic";
  return certificate;
}

LastRow last_row_of(const arm::Sensor& sensor) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return LastRow::hub_angle;
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_displacement:
      return LastRow::tip_displacement;
    case arm::SensorKind::tip_deflection:
      return LastRow::tip_deflection;
    case arm::SensorKind::strain:
      return LastRow::strain;
  }
  return LastRow::hub_angle;
}

}  // namespace

Certificate certify_poles(const arm::Arm& arm, std::span<const double> lambdas,
                          const CertificateOptions& options) {
  return certify_self_adjoint(arm, LastRow::hub_torque, lambdas, options);
}

Certificate certify_hub_zeros(const arm::Arm& arm, std::span<const double> lambdas,
                              const CertificateOptions& options) {
  return certify_self_adjoint(arm, LastRow::hub_angle, lambdas, options);
}

Certificate certify_zeros(const arm::Arm& arm, const arm::Sensor& sensor,
                          std::span<const std::complex<double>> s_rad_per_s,
                          const CertificateOptions& options) {
  const Problem problem(arm, last_row_of(sensor), arm::placed(sensor, arm).position_m);
  arm::require_responsive(sensor, arm);
  std::vector<ZeroLocus> loci;
  std::vector<GivenLambda> given;
  for (const std::complex<double> s : s_rad_per_s) {
    loci.push_back(s.real() == 0.0   ? ZeroLocus::positive_axis
                   : s.imag() == 0.0 ? ZeroLocus::negative_axis
                                     : ZeroLocus::off_axis);
    // s^2 = -lambda^4 omega_scale^2, on the branch 0 <= arg lambda <= pi/4.
    given.push_back([&problem, s] {
      return sqrt(ComplexBall(RealBall(s.imag()), RealBall(s.real())) /
                  ComplexBall(DimensionlessArm(problem.arm()).omega_scale));
    });
  }
  long values_left = options.max_function_values;
  const auto count = [&](const RealBall& beyond) {
    return problem.function().count_within(beyond, values_left);
  };
  Certificate certificate = certify(problem, loci, given, options, count);
  certificate.method =
      "change of sign, winding number about each complex zero, argument principle on |lambda| = "
      "const, all in ball arithmetic";
  return certificate;
}

}  // namespace flexarm::exact_tf
