#include "fem/trusted_zeros.hpp"

#include "fem/sensor_row.hpp"
#include "fem/transmission_zeros.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace flexarm::fem {

namespace {

using Complex = std::complex<double>;

/// The one of +-sqrt(w), +-conj(sqrt(w)) with Re >= 0 and Im >= 0.
Complex first_quadrant_root(Complex w) {
  const Complex s = std::sqrt(w);
  return {std::abs(s.real()), std::abs(s.imag())};
}

struct Candidate {
  Complex s;
  std::optional<Complex> counterpart;
  double relative_change = std::numeric_limits<double>::infinity();
};

bool same(Complex a, Complex b) {
  constexpr double kSameRoot = 1e-8;
  return std::abs(a - b) <= kSameRoot * std::abs(b);
}

}  // namespace

arm::ZeroSet trusted_zeros(const Discretisation& model, const Discretisation& checking,
                           const arm::Arm& arm, const arm::Sensor& sensor, int count,
                           const TrustOptions& options) {
  // Trusted roots lie among the smallest; some spurious ones may lie between them.
  constexpr int kSpare = 4;
  constexpr int kFollowingSteps = 30;
  arm::ZeroSet zeros;
  const SensorRow row = sensor_row(model, arm, sensor);
  if (row.c.isZero(0.0)) return zeros;
  const SensorRow checking_row = sensor_row(checking, arm, sensor);

  const PencilRoots roots = pencil_roots(
      model, row.c, std::min(count + kSpare, model.clamped_size()), options.eigen_tolerance);
  std::vector<Candidate> candidates;
  for (const Complex w : roots.w) {
    Candidate candidate{first_quadrant_root(w), std::nullopt};
    const FollowedRoot followed = follow_root(checking, checking_row.c, w, kFollowingSteps);
    if (followed.converged) {
      candidate.counterpart = first_quadrant_root(followed.w);
      candidate.relative_change =
          std::abs(candidate.s - *candidate.counterpart) / std::abs(*candidate.counterpart);
    }
    candidates.push_back(candidate);
  }
  for (const Candidate& candidate : candidates) {
    if (static_cast<int>(zeros.s_rad_per_s.size()) >= count) break;
    const bool taken = candidate.counterpart && std::ranges::any_of(candidates, [&](const auto& c) {
                         return c.counterpart && same(*c.counterpart, *candidate.counterpart) &&
                                c.relative_change < candidate.relative_change;
                       });
    if (candidate.relative_change <= options.agreement && !taken) {
      zeros.s_rad_per_s.push_back(candidate.s);
      continue;
    }
    std::string reason =
        !candidate.counterpart ? "no counterpart on the checking mesh"
        : taken                ? "a nearer root has the same counterpart on the checking mesh"
                : fmt::format("moves by more than {} on the checking mesh", options.agreement);
    zeros.rejected.push_back({candidate.s, candidate.relative_change, std::move(reason)});
  }
  zeros.infinite = roots.infinite;
  zeros.count.found = static_cast<int>(zeros.s_rad_per_s.size());
  zeros.summary = {"Rosenbrock pencil by eigenvalues at s = 0, Newton's method", roots.newton_steps,
                   roots.largest_step, roots.converged};
  return zeros;
}

}  // namespace flexarm::fem
