#include "diagnose/predictors/predicted_roots.hpp"

#include "arm/input_error.hpp"
#include "diagnose/observations.hpp"
#include "exact_tf/exact_arm.hpp"
#include "response/arm_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace flexarm::diagnose {

namespace {

using Complex = std::complex<double>;

struct Root {
  double frequency_Hz = 0.0;
  double damping_ratio = 0.0;
};

Root as_root(Complex s) {
  return {std::abs(s) / (2.0 * std::numbers::pi), -s.real() / std::abs(s)};
}

/// Of two real poles the geometric mean is the natural frequency.
Root as_root(const arm::PolePair& pair) {
  const Complex sum = pair.first_rad_per_s + pair.second_rad_per_s;
  const double omega = std::sqrt(std::abs(pair.first_rad_per_s * pair.second_rad_per_s));
  return {omega / (2.0 * std::numbers::pi), -sum.real() / (2.0 * omega)};
}

/// The zero of the damped response beside an undamped one, by secant steps.
Complex damped_zero(const exact_tf::ExactArm& exact, const arm::Sensor& sensor, Complex undamped) {
  constexpr int kMostSteps = 20;
  constexpr double kFound = 1e-10;
  Complex before = undamped;
  Complex now = undamped * Complex(1.0, 1e-3);
  Complex value_before = exact.transfer_function(sensor, before);
  for (int i = 0; i < kMostSteps; ++i) {
    const Complex value = exact.transfer_function(sensor, now);
    if (value == value_before) break;
    const Complex step = value * (now - before) / (value - value_before);
    before = now;
    value_before = value;
    now -= step;
    if (std::abs(step) <= kFound * std::abs(now)) break;
  }
  return now;
}

/// The `count` lowest zeros on the imaginary axis, with Im s > 0.
std::vector<Complex> antiresonances(const exact_tf::ExactArm& exact, const arm::Sensor& sensor,
                                    int count) {
  // Real zeros of a tip lie between antiresonances, or are all that there are.
  constexpr int kLeastSearched = 32;
  const int most = std::max(kLeastSearched, 4 * count);
  std::vector<Complex> found;
  for (int searched = count;; searched = std::min(2 * searched, most)) {
    found.clear();
    for (const Complex& s : exact.zeros(sensor, searched).s_rad_per_s) {
      if (s.real() == 0.0) found.push_back(s);
    }
    if (std::ssize(found) >= count) return found;
    if (searched == most) break;
  }
  throw arm::InputError(
      fmt::format("{} zero {}: {} of the lowest {} zeros of the arm are on the imaginary axis",
                  arm::to_string(sensor), count, found.size(), most));
}

int highest_order(const measured::ModalTable& table, const ModalGroup& group) {
  int order = 1;
  for (const std::size_t i : group.entries) order = std::max(order, table[i].order.value());
  return order;
}

}  // namespace

void predict_roots(const arm::Arm& arm, const measured::ModalTable& table,
                   Eigen::Ref<Eigen::VectorXd> values) {
  const exact_tf::ExactArm exact(response::take_apart(arm).linear, exact_tf::Arithmetic::working);
  const bool is_damped = exact.linear().is_damped();
  Eigen::Index at = 0;
  for (const ModalGroup& group : modal_groups(table)) {
    const int count = highest_order(table, group);
    std::vector<Complex> zeros;
    arm::DampedPoleSet poles;
    if (group.zeros_of) {
      zeros = antiresonances(exact, *group.zeros_of, count);
    } else {
      poles = exact.damped_poles(count);
    }
    for (const std::size_t i : group.entries) {
      const measured::ModalEntry& entry = table[i];
      const auto k = static_cast<std::size_t>(entry.order.value() - 1);
      Root root;
      if (!group.zeros_of) {
        root = as_root(poles.flexible.at(k));
      } else {
        root = as_root(zeros.at(k));
        if (entry.damping_ratio && is_damped) {
          root.damping_ratio = as_root(damped_zero(exact, *group.zeros_of, zeros[k])).damping_ratio;
        }
      }
      if (entry.frequency_Hz) values(at++) = root.frequency_Hz;
      if (entry.damping_ratio) values(at++) = root.damping_ratio;
    }
  }
}

}  // namespace flexarm::diagnose
