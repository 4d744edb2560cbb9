#include "measured/modal/modal_gains.hpp"

#include "arm/input_error.hpp"
#include "measured/modal/propagated_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::VectorXd;

/// Differences of this many standard errors are derivatives to 1e-8 of the curvature's part.
constexpr double kDifferenceStep = 1e-4;
/// Slope and gains are a root of a residue and a ratio to it: to first order only where it is known
/// well. A residue that noise makes up would else pass wherever noise makes it large.
constexpr double kMostRelative = 0.1;
constexpr int kNewtonSteps = 4;

/// The fit at other parameters, and the roots that belong to it.
class MovedFit {
 public:
  MovedFit(const ModalFit& fit, const VectorXd& parameters) : fit_(fit) {
    const Index theta = fit.blocks.parameters();
    blocks_ = fit.blocks.with(parameters.head(theta));
    for (std::size_t j = 0; j < fit.transfers.size(); ++j) {
      VectorXd own(fit.transfers[j].parameters());
      own << parameters.head(theta),
          parameters.segment(fit.first_parameter(j), fit.transfers[j].beta().size());
      transfers_.push_back(fit.transfers[j].with(own));
    }
  }

  const FittedTransfer& transfer(std::size_t sensor) const { return transfers_[sensor]; }
  double omega(std::size_t block) const { return blocks_.blocks[block].omega_rad_per_s(); }
  double b0(std::size_t sensor, std::size_t block) const {
    return transfers_[sensor].numerator(block).b0;
  }
  /// |s| of a zero of the fit, followed to these parameters.
  double zero_size(std::size_t sensor, const FittedZero& zero) const {
    Complex s = zero.s_rad_per_s;
    for (int i = 0; i < kNewtonSteps; ++i) {
      s -= transfers_[sensor].value(s) / transfers_[sensor].s_derivative(s);
    }
    return std::abs(s);
  }

 private:
  const ModalFit& fit_;
  BlockSet blocks_;
  std::vector<FittedTransfer> transfers_;
};

using GainOf = std::function<double(const MovedFit&)>;

Estimate estimate(const ModalFit& fit, const GainOf& quantity) {
  Estimate result{quantity(MovedFit(fit, fit.parameters)), 0.0};
  VectorXd gradient = VectorXd::Zero(fit.parameters.size());
  for (Index i = 0; i < gradient.size(); ++i) {
    const double step = kDifferenceStep * std::sqrt(fit.covariance(i, i));
    if (!(step > 0.0)) continue;
    VectorXd moved = fit.parameters;
    moved(i) += step;
    const double above = quantity(MovedFit(fit, moved));
    moved(i) -= 2.0 * step;
    gradient(i) = (above - quantity(MovedFit(fit, moved))) / (2.0 * step);
  }
  result.standard_error = propagated_error(gradient.transpose(), fit.covariance);
  return result;
}

struct Sensors {
  std::vector<std::size_t> hub;  ///< hub angle, hub velocity: those measured
  std::optional<std::size_t> tip;
};

Sensors sensors_of(const ModalFit& fit) {
  Sensors sensors{{}, fit.find(arm::SensorKind::tip_acceleration)};
  for (const auto kind : {arm::SensorKind::hub_angle, arm::SensorKind::hub_velocity}) {
    if (const auto at = fit.find(kind)) sensors.hub.push_back(*at);
  }
  if (sensors.hub.empty()) {
    throw arm::InputError("modal gains: need hub_angle or hub_velocity");
  }
  return sensors;
}

/// The hub sensor that knows a block's residue best.
std::size_t best_hub(const ModalFit& fit, const Sensors& sensors, std::size_t block) {
  return *std::ranges::min_element(
      sensors.hub, {}, [&](std::size_t j) { return fit.sensors[j].numerators[block].b0_std; });
}

/// A block's b0 at the hub: angle and velocity have the same, each weighted by its own variance.
double hub_b0(const ModalFit& fit, const MovedFit& moved, const Sensors& sensors,
              std::size_t block) {
  double sum = 0.0;
  double weights = 0.0;
  for (const std::size_t j : sensors.hub) {
    const double deviation = fit.sensors[j].numerators[block].b0_std;
    const double weight = deviation > 0.0 ? 1.0 / (deviation * deviation) : 1.0;
    sum += weight * moved.b0(j, block);
    weights += weight;
  }
  return sum / weights;
}

/// Zeros that alternate with the poles: one below each mode, as those of a hub do.
std::vector<FittedZero> antiresonances(const ModalFit& fit, std::size_t hub,
                                       const std::vector<std::size_t>& modes) {
  std::vector<FittedZero> kept;
  for (const FittedZero& zero : fit.sensors[hub].zeros) {
    const bool below_last =
        !modes.empty() && zero.frequency_Hz < fit.blocks.blocks[modes.back()].omega_rad_per_s() /
                                                  (2.0 * std::numbers::pi);
    if (zero.is_told && zero.s_rad_per_s.imag() > 0.0 && below_last &&
        std::abs(zero.damping_ratio) < 0.5) {
      kept.push_back(zero);
    }
  }
  return kept;
}

double product_slope(const MovedFit& moved, std::size_t hub, const std::vector<std::size_t>& modes,
                     const std::vector<FittedZero>& zeros, std::size_t block) {
  const double square = std::pow(moved.omega(block), 2);
  double value = -1.0;
  for (const FittedZero& zero : zeros) {
    value *= 1.0 - square / std::pow(moved.zero_size(hub, zero), 2);
  }
  for (const std::size_t other : modes) {
    if (other != block) value /= 1.0 - square / std::pow(moved.omega(other), 2);
  }
  return std::sqrt(value);
}

}  // namespace

ModalGains modal_gains(const ModalFit& fit, std::optional<double> total_inertia_kg_m2) {
  const Sensors sensors = sensors_of(fit);
  ModalGains gains;
  if (!total_inertia_kg_m2 && !fit.blocks.rigid) {
    throw arm::InputError("modal gains: I_T must be given for an arm with a restrained hub");
  }
  const GainOf inertia = [&](const MovedFit& moved) {
    return total_inertia_kg_m2 ? *total_inertia_kg_m2 : 1.0 / hub_b0(fit, moved, sensors, 0);
  };
  gains.total_inertia_kg_m2 = estimate(fit, inertia);
  if (!(gains.total_inertia_kg_m2.value > 0.0)) {
    throw UnphysicalInertia(fmt::format(
        "1/I_T = {:.3g} 1/(kg m^2) is not positive; check the signs of torque and hub sensor, or "
        "give I_T if friction dominates the rigid-body motion",
        1.0 / gains.total_inertia_kg_m2.value));
  }
  std::vector<std::size_t> modes;
  const std::size_t first = fit.blocks.rigid ? 1 : 0;
  for (std::size_t i = 0; i < fit.poles.size(); ++i) {
    if (fit.poles[i].is_mode) modes.push_back(first + i);
  }
  const std::size_t zeros_of = modes.empty() ? sensors.hub[0] : best_hub(fit, sensors, modes[0]);
  const auto zeros = antiresonances(fit, zeros_of, modes);
  for (const std::size_t block : modes) {
    ModalGain gain;
    gain.frequency_Hz = fit.poles[block - first].frequency_Hz;
    const GainOf slope = [&](const MovedFit& moved) {
      return std::sqrt(inertia(moved) * hub_b0(fit, moved, sensors, block));
    };
    const auto accepted = [&](const GainOf& quantity) -> std::optional<Estimate> {
      const Estimate found = estimate(fit, quantity);
      if (!(found.standard_error <= kMostRelative * std::abs(found.value))) return std::nullopt;
      return found;
    };
    gain.hub_slope = accepted(slope);
    if (zeros.size() == modes.size()) {
      gain.hub_slope_of_product = accepted([&](const MovedFit& moved) {
        return product_slope(moved, zeros_of, modes, zeros, block);
      });
    }
    if (sensors.tip) {
      gain.tip_gain_m = accepted([&](const MovedFit& moved) {
        return inertia(moved) * moved.b0(*sensors.tip, block) / slope(moved);
      });
      gain.tip_gain_of_ratio_m = accepted([&](const MovedFit& moved) {
        const Complex s(0.0, moved.omega(block));
        const std::size_t j = best_hub(fit, sensors, block);
        const int derivatives = arm::derivative_order(fit.sensors[j].sensor);
        const Complex hub = moved.transfer(j).value(s) / (derivatives == 1 ? s : 1.0);
        const Complex ratio = moved.transfer(*sensors.tip).value(s) / hub;
        return -ratio.real() * slope(moved) / std::norm(s);
      });
    }
    gains.modes.push_back(gain);
  }
  return gains;
}

}  // namespace flexarm::measured
