#include "compare/sweeps/sweep_result.hpp"

#include "arm/linear_arm.hpp"
#include "compare/features.hpp"
#include "compare/finding.hpp"
#include "compare/sweeps/sweep_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

namespace flexarm::compare {

namespace {

using Values = std::vector<std::vector<SweepPoint>>;
using OptionalRoots = std::vector<std::optional<std::complex<double>>>;

/// The roots of a family that a model gives for a point.
const RootList& roots_of(const SweepTask& task, const SweepPoint& point,
                         const SweepFamily& family) {
  if (!family.zeros_of) return point.damped_poles_rad_per_s;
  const auto& sensors = task.questions.sensors;
  const auto sensor = std::ranges::find(sensors, *family.zeros_of) - sensors.begin();
  return point.zeros_rad_per_s[static_cast<std::size_t>(sensor)];
}

SweepCurve empty_curve(const SweepTask& task, const SweepFamily& family, std::size_t number) {
  return {family, static_cast<int>(number) + 1,
          std::vector<OptionalRoots>(task.models.size(), OptionalRoots(task.points()))};
}

void add_poles(const SweepTask& task, const Values& points, std::vector<SweepCurve>& curves) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(task.questions.poles); ++k) {
    SweepCurve curve = empty_curve(task, {}, k);
    for (std::size_t m = 0; m < points.size(); ++m) {
      for (std::size_t p = 0; p < points[m].size(); ++p) {
        const auto& omega = points[m][p].omega_rad_per_s;
        if (k < omega.size()) curve.s_rad_per_s[m][p] = std::complex(0.0, omega[k]);
      }
    }
    curves.push_back(std::move(curve));
  }
}

/// Another model's roots as they stand for those of the first one.
OptionalRoots matched_with(const SweepFamily& family, const RootList& reference,
                           const RootList& found) {
  if (!family.is_ordered()) return match_nearest(reference, found);
  OptionalRoots matched(found.begin(), found.end());
  matched.resize(reference.size());
  return matched;
}

/// The curves of a family whose index in the reference's list is [curve][point].
void add_curves(const SweepTask& task, const Values& points, const SweepFamily& family,
                const std::vector<std::vector<std::size_t>>& index,
                std::vector<SweepCurve>& curves) {
  const std::size_t first = curves.size();
  for (std::size_t n = 0; n < index.size(); ++n) curves.push_back(empty_curve(task, family, n));
  for (std::size_t p = 0; p < task.points(); ++p) {
    const auto& reference = roots_of(task, points.front()[p], family);
    for (std::size_t m = 0; m < points.size(); ++m) {
      const auto& found = roots_of(task, points[m][p], family);
      const auto matched = m == 0 ? OptionalRoots(found.begin(), found.end())
                                  : matched_with(family, reference, found);
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

/// How many of a family's roots, smallest in |s|, are shown and judged.
std::size_t wanted(const SweepTask& task, const SweepFamily& family) {
  return family.zeros_of ? static_cast<std::size_t>(task.questions.zeros)
                         : std::numeric_limits<std::size_t>::max();
}

/// Follows a family and adds its curves.
void add_tracks(const Values& points, const SweepFamily& family, const SweepRun& run,
                SweepResult& result) {
  const SweepTask& task = result.task;
  TrackedRoots roots{family, {}, {}, wanted(task, family)};
  for (const SweepPoint& point : points.front()) {
    roots.at_points.push_back(roots_of(task, point, family));
  }
  roots.roots_of = [&task, family](const response::AnyFormulation& formulation) {
    if (family.zeros_of) {
      const int count = zeros_asked(*family.zeros_of, task.questions);
      return response::zeros(formulation, *family.zeros_of, count).s_rad_per_s;
    }
    const int count = task.questions.poles;
    return damped_poles(formulation, response::poles(formulation, count), count);
  };
  GridTracks tracks = track_grid(task, roots, run);
  add_curves(task, points, family, tracks.index, result.curves);
  std::ranges::move(tracks.events, std::back_inserter(result.events));
  result.further_evaluations += tracks.further_evaluations;
}

/// Gives the tracks of damped poles the numbers of the undamped poles that they begin beside.
void number_as_undamped(SweepResult& result) {
  const auto first = std::ranges::find_if(
      result.curves, [](const SweepCurve& curve) { return curve.family.damped; });
  const std::span damped(first, result.curves.end());
  const std::span undamped(result.curves.begin(), first);
  const auto begin_of = [](const SweepCurve& curve) {
    const auto& s = curve.s_rad_per_s.front().front();
    return s ? std::abs(*s) : std::numeric_limits<double>::infinity();
  };
  std::map<int, int> numbers;  // by that of the track
  for (const SweepCurve& pole : undamped) {
    const SweepCurve* nearest = nullptr;
    const auto distance = [&](const SweepCurve& curve) {
      return std::abs(std::log(begin_of(curve) / begin_of(pole)));
    };
    for (const SweepCurve& curve : damped) {
      if (numbers.contains(curve.number) || !(distance(curve) < INFINITY)) continue;
      if (nearest == nullptr || distance(curve) < distance(*nearest)) nearest = &curve;
    }
    if (nearest != nullptr) numbers[nearest->number] = pole.number;
  }
  int next = static_cast<int>(undamped.size());
  bool has_lowest = false;
  for (SweepCurve& curve : damped) {
    if (numbers.contains(curve.number)) continue;
    const bool is_lowest = !has_lowest && begin_of(curve) < begin_of(undamped.front());
    numbers[curve.number] = is_lowest ? 0 : ++next;
    has_lowest = has_lowest || is_lowest;
  }
  for (SweepCurve& curve : damped) curve.number = numbers.at(curve.number);
  std::ranges::sort(damped, {}, &SweepCurve::number);
  for (SweepEvent& event : result.events) {
    for (int* track : {&event.track, &event.other}) {
      if (*track != kNoTrack) *track = numbers.at(*track);
    }
  }
}

bool has_damping(const SweepTask& task) {
  for (std::size_t p = 0; p < task.points(); ++p) {
    if (arm::linear_arm(task.arm_of(p)).is_damped()) return true;
  }
  return false;
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

SweepModes modes_of(const SweepTask& task, const Values& points) {
  SweepModes modes;
  if (!task.questions.modes) return modes;
  modes.hub_slope = table_of(task, points, &SweepPoint::hub_slope);
  modes.tip_value_m = table_of(task, points, &SweepPoint::tip_value_m);
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
  if (curve.family.is_ordered()) return true;
  const auto& list = roots_of(task, points.front()[point], curve.family);
  const auto end =
      list.begin() + static_cast<std::ptrdiff_t>(std::min(list.size(), wanted(task, curve.family)));
  return std::find(list.begin(), end, *reference) != end;
}

void judge_roots(const Values& points, const SweepTolerances& tolerances, SweepResult& result) {
  std::vector<SweepFamily> families;
  for (const SweepCurve& curve : result.curves) {
    if (families.empty() || families.back() != curve.family) families.push_back(curve.family);
  }
  for (const SweepFamily& family : families) {
    for (std::size_t m = 1; m < points.size(); ++m) {
      Judge judge(label(family), result.task.models[m].name, tolerances.roots);
      for (const SweepCurve& curve : result.curves) {
        if (curve.family != family) continue;
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

double damping_ratio(std::complex<double> s_rad_per_s) {
  return -s_rad_per_s.real() / std::abs(s_rad_per_s);
}

bool SweepFamily::is_ordered() const {
  return zeros_of ? arm::is_collocated(*zeros_of) : !damped;
}

std::string label(const SweepFamily& family) {
  if (family.zeros_of) return arm::to_string(*family.zeros_of) + " zeros";
  return family.damped ? "damped poles" : "poles";
}

bool SweepResult::agrees() const {
  return std::ranges::all_of(agreement, &SweepAgreement::agrees);
}

SweepResult assemble(const SweepTask& task, SweepValues values, const SweepRun& run,
                     const SweepTolerances& tolerances) {
  SweepResult result;
  result.task = task;
  const Values& points = values.points;
  for (const Model& model : task.models) {
    result.degrees_of_freedom.push_back(response::degrees_of_freedom(model.make(task.arm_of(0))));
  }
  add_poles(task, points, result.curves);
  if (task.questions.modes && has_damping(task)) {
    add_tracks(points, {std::nullopt, true}, run, result);
    number_as_undamped(result);
  }
  for (const auto& sensor : task.questions.sensors) {
    const SweepFamily family{sensor, false};
    if (family.is_ordered()) {
      add_curves(task, points, family, in_order(task), result.curves);
    } else {
      add_tracks(points, family, run, result);
    }
  }
  result.modes = modes_of(task, points);
  judge_roots(points, tolerances, result);
  judge_modes("hub slopes", result.modes.hub_slope, tolerances.shapes, result);
  judge_modes("end-point values", result.modes.tip_value_m, tolerances.shapes, result);
  return result;
}

}  // namespace flexarm::compare
