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

/// Natural frequency |s|/2 pi; of two real roots their geometric mean.
Root as_root(const arm::PolePair& pair) {
  const Complex sum = pair.first_rad_per_s + pair.second_rad_per_s;
  const double omega = std::sqrt(std::abs(pair.first_rad_per_s * pair.second_rad_per_s));
  return {omega / (2.0 * std::numbers::pi), -sum.real() / (2.0 * omega)};
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

std::vector<Root> damped_antiresonances(const exact_tf::ExactArm& exact, const arm::Sensor& sensor,
                                        int count) {
  std::vector<Complex> undamped = antiresonances(exact, sensor, count);
  undamped.resize(static_cast<std::size_t>(count));
  std::vector<Root> roots;
  for (const auto& pair : exact.damped_zeros(sensor, undamped).pairs) {
    if (!pair) {
      throw arm::InputError(fmt::format("{} zeros: not found with the damping of the arm",
                                        arm::to_string(sensor)));
    }
    roots.push_back(as_root(*pair));
  }
  return roots;
}

std::vector<Root> damped_poles(const exact_tf::ExactArm& exact, int count) {
  std::vector<Root> roots;
  for (const auto& pair : exact.damped_poles(count).flexible) roots.push_back(as_root(pair));
  return roots;
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
  Eigen::Index at = 0;
  for (const ModalGroup& group : modal_groups(table)) {
    const int count = highest_order(table, group);
    const std::vector<Root> roots = group.zeros_of ? damped_antiresonances(exact, *group.zeros_of, count)
                                                   : damped_poles(exact, count);
    for (const std::size_t i : group.entries) {
      const measured::ModalEntry& entry = table[i];
      const auto k = static_cast<std::size_t>(entry.order.value() - 1);
      const Root& root = roots.at(k);
      if (entry.frequency_Hz) values(at++) = root.frequency_Hz;
      if (entry.damping_ratio) values(at++) = root.damping_ratio;
    }
  }
}

}  // namespace flexarm::diagnose
