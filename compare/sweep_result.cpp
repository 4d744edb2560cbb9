#include "compare/sweep_result.hpp"

#include "arm/linear_arm.hpp"
#include "compare/features.hpp"
#include "compare/sweep_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flexarm::compare {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

using Values = std::vector<std::vector<SweepPoint>>;
using OptionalRoots = std::vector<std::optional<std::complex<double>>>;

SweepCurve empty_curve(const SweepTask& task, const std::optional<arm::Sensor>& zeros_of,
                       std::size_t number) {
  return {zeros_of, static_cast<int>(number) + 1,
          std::vector<OptionalRoots>(task.models.size(), OptionalRoots(task.points()))};
}

void add_poles(const SweepTask& task, const Values& points, std::vector<SweepCurve>& curves) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(task.questions.poles); ++k) {
    SweepCurve curve = empty_curve(task, std::nullopt, k);
    for (std::size_t m = 0; m < points.size(); ++m) {
      for (std::size_t p = 0; p < points[m].size(); ++p) {
        const auto& omega = points[m][p].omega_rad_per_s;
        if (k < omega.size()) curve.s_rad_per_s[m][p] = std::complex(0.0, omega[k]);
      }
    }
    curves.push_back(std::move(curve));
  }
}

/// The curves of zeros whose index in the reference's list is [curve][point].
void add_zeros(const SweepTask& task, const Values& points, std::size_t sensor,
               const std::vector<std::vector<std::size_t>>& index,
               std::vector<SweepCurve>& curves) {
  const FeatureFamily family{task.questions.sensors[sensor], task.questions.zeros};
  const std::size_t first = curves.size();
  for (std::size_t n = 0; n < index.size(); ++n) {
    curves.push_back(empty_curve(task, family.zeros_of, n));
  }
  for (std::size_t p = 0; p < task.points(); ++p) {
    const auto& reference = points.front()[p].zeros_rad_per_s[sensor];
    for (std::size_t m = 0; m < points.size(); ++m) {
      const auto& found = points[m][p].zeros_rad_per_s[sensor];
      const auto matched =
          m == 0 ? OptionalRoots(found.begin(), found.end()) : match(family, reference, found);
      for (std::size_t n = 0; n < index.size(); ++n) {
        if (index[n][p] < matched.size()) {
          curves[first + n].s_rad_per_s[m][p] = matched[index[n][p]];
        }
      }
    }
  }
}

/// Orders as tracks: zeros of a collocated sensor never meet.
std::vector<std::vector<std::size_t>> in_order(const SweepTask& task) {
  std::vector<std::vector<std::size_t>> index;
  for (int k = 0; k < task.questions.poles; ++k) {
    index.emplace_back(task.points(), static_cast<std::size_t>(k));
  }
  return index;
}

SweepTable table_of(const SweepTask& task, const Values& points,
                    std::vector<double> SweepPoint::*member) {
  const auto orders = static_cast<std::size_t>(task.questions.poles);
  SweepTable table(points.size(), std::vector(orders, std::vector(task.points(), kMissing)));
  for (std::size_t m = 0; m < points.size(); ++m) {
    for (std::size_t p = 0; p < task.points(); ++p) {
      const auto& values = points[m][p].*member;
      for (std::size_t k = 0; k < std::min(orders, values.size()); ++k) table[m][k][p] = values[k];
    }
  }
  return table;
}

double damping_ratio(const arm::PolePair& pair) {
  const double product = (pair.first_rad_per_s * pair.second_rad_per_s).real();
  return -(pair.first_rad_per_s + pair.second_rad_per_s).real() / (2.0 * std::sqrt(product));
}

void add_damped_poles(const SweepTask& task, const Values& points, SweepModes& modes) {
  const auto has_damping = [](const SweepPoint& point) { return !point.damped_poles.empty(); };
  const bool damped = std::ranges::any_of(
      points, [&](const auto& of_model) { return std::ranges::any_of(of_model, has_damping); });
  if (!damped) return;
  const auto orders = static_cast<std::size_t>(task.questions.poles);
  modes.damping_ratio.assign(points.size(),
                             std::vector(orders, std::vector(task.points(), kMissing)));
  modes.damped_poles.resize(points.size());
  for (std::size_t m = 0; m < points.size(); ++m) {
    modes.damped_poles[m].resize(orders);
    for (auto& order : modes.damped_poles[m]) order.resize(task.points());
    for (std::size_t p = 0; p < task.points(); ++p) {
      const SweepPoint& point = points[m][p];
      for (std::size_t k = 0; k < std::min(orders, point.omega_rad_per_s.size()); ++k) {
        const bool undamped = point.damped_poles.empty();
        if (!undamped && k >= point.damped_poles.size()) continue;
        const std::complex<double> pole(0.0, point.omega_rad_per_s[k]);
        const auto pair = undamped ? arm::PolePair{pole, std::conj(pole)} : point.damped_poles[k];
        modes.damped_poles[m][k][p] = pair;
        modes.damping_ratio[m][k][p] = damping_ratio(pair);
      }
    }
  }
}

SweepModes modes_of(const SweepTask& task, const Values& points) {
  SweepModes modes;
  if (!task.questions.modes) return modes;
  modes.hub_slope = table_of(task, points, &SweepPoint::hub_slope);
  modes.tip_value_m = table_of(task, points, &SweepPoint::tip_value_m);
  add_damped_poles(task, points, modes);
  return modes;
}

/// Keeps the worst of the distances it is shown.
class Judge {
 public:
  Judge(std::string quantity, std::string model, double tolerance) {
    agreement_.quantity = std::move(quantity);
    agreement_.model = std::move(model);
    agreement_.tolerance = tolerance;
  }

  /// NaN: the model has no such value.
  void see(double distance, int number, std::size_t point) {
    if (std::isnan(distance)) {
      if (agreement_.missing++ == 0) agreement_.first_missing_point = point;
      return;
    }
    if (agreement_.compared++ > 0 && distance <= agreement_.worst) return;
    agreement_.worst = distance;
    agreement_.worst_number = number;
    agreement_.worst_point = point;
  }

  const SweepAgreement& agreement() const { return agreement_; }

 private:
  SweepAgreement agreement_;
};

/// A root of the reference that is beyond those asked for is shown, not judged.
bool is_judged(const SweepTask& task, const Values& points, const SweepCurve& curve,
               std::size_t point) {
  const auto& reference = curve.s_rad_per_s.front()[point];
  if (!reference) return false;
  if (!curve.zeros_of || arm::is_collocated(*curve.zeros_of)) return true;
  const auto sensor = static_cast<std::size_t>(
      std::ranges::find(task.questions.sensors, *curve.zeros_of) - task.questions.sensors.begin());
  const auto& list = points.front()[point].zeros_rad_per_s[sensor];
  const auto last = std::min(list.size(), static_cast<std::size_t>(task.questions.zeros));
  return std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(last), *reference) !=
         list.begin() + static_cast<std::ptrdiff_t>(last);
}

void judge_roots(const Values& points, const SweepTolerances& tolerances, SweepResult& result) {
  std::vector<std::optional<arm::Sensor>> families = {std::nullopt};
  for (const auto& sensor : result.task.questions.sensors) families.emplace_back(sensor);
  for (const auto& zeros_of : families) {
    const std::string quantity = zeros_of ? arm::to_string(*zeros_of) + " zeros" : "poles";
    for (std::size_t m = 1; m < points.size(); ++m) {
      Judge judge(quantity, result.task.models[m].name, tolerances.roots);
      for (const SweepCurve& curve : result.curves) {
        if (curve.zeros_of != zeros_of) continue;
        for (std::size_t p = 0; p < result.task.points(); ++p) {
          if (!is_judged(result.task, points, curve, p)) continue;
          const auto& found = curve.s_rad_per_s[m][p];
          judge.see(found ? relative_distance(*found, *curve.s_rad_per_s.front()[p]) : kMissing,
                    curve.number, p);
        }
      }
      result.agreement.push_back(judge.agreement());
    }
  }
}

void judge_modes(const char* quantity, const SweepTable& table, double tolerance,
                 SweepResult& result) {
  for (std::size_t m = 1; m < table.size(); ++m) {
    Judge judge(quantity, result.task.models[m].name, tolerance);
    for (std::size_t p = 0; p < result.task.points(); ++p) {
      double largest = 0.0;
      for (const auto& order : table.front()) {
        if (std::abs(order[p]) > largest) largest = std::abs(order[p]);
      }
      for (std::size_t k = 0; k < table[m].size(); ++k) {
        if (std::isnan(table.front()[k][p])) continue;
        const double difference = std::abs(table[m][k][p] - table.front()[k][p]);
        judge.see(largest > 0.0 ? difference / largest : difference, static_cast<int>(k) + 1, p);
      }
    }
    result.agreement.push_back(judge.agreement());
  }
}

}  // namespace

bool SweepResult::agrees() const {
  return std::ranges::all_of(agreement, &SweepAgreement::agrees);
}

SweepResult assemble(const SweepTask& task, SweepValues values, const SweepRun& run,
                     const SweepTolerances& tolerances) {
  SweepResult result;
  result.task = task;
  const Values& points = values.points;
  for (const SweepModel& model : task.models) {
    result.degrees_of_freedom.push_back(response::degrees_of_freedom(model.make(task.arm_of(0))));
  }
  add_poles(task, points, result.curves);
  for (std::size_t k = 0; k < task.questions.sensors.size(); ++k) {
    if (arm::is_collocated(task.questions.sensors[k])) {
      add_zeros(task, points, k, in_order(task), result.curves);
      continue;
    }
    GridTracks tracks = track_grid(task, points.front(), k, run);
    add_zeros(task, points, k, tracks.index, result.curves);
    std::ranges::move(tracks.events, std::back_inserter(result.events));
    result.further_evaluations += tracks.further_evaluations;
  }
  result.modes = modes_of(task, points);
  judge_roots(points, tolerances, result);
  judge_modes("hub slopes", result.modes.hub_slope, tolerances.shapes, result);
  judge_modes("end-point values", result.modes.tip_value_m, tolerances.shapes, result);
  judge_modes("damping ratios", result.modes.damping_ratio, tolerances.shapes, result);
  return result;
}

}  // namespace flexarm::compare
