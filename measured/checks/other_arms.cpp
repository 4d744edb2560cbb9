#include "measured/checks/other_arms.hpp"

#include "measured/checks/data_check_described.hpp"
#include "measured/checks/data_check_transform.hpp"
#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace flexarm::measured {

namespace {

/// Sizes of a variation that are tried first; then the best is refined by ever smaller steps.
constexpr std::array kTriedSizes = {0.1, 0.3, 0.5, 0.7, 0.9};
constexpr double kFirstSizeStep = 0.1;
constexpr int kSizeRefinements = 4;
/// By how much an arm must be nearer: two that differ by less are alike. Beside friction a scale of
/// the torque and two effects make more nearly the same.
constexpr double kNearerArm = 0.002;
constexpr double kNearerThanScaledTorque = 0.01;
/// An effect that brings the arm so many times nearer than another sign is what is wrong. A scale
/// is seen beside friction that takes more.
constexpr double kMuchMore = 3.0;

/// The first samples of signals, with the faults that were found taken out.
class JudgedRecord {
 public:
  JudgedRecord(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
               double period_s, bool from_rest, const std::vector<DataFinding>& faults,
               const arm::Deadline& deadline)
      : signals_(signals.begin(), signals.end()), deadline_(deadline) {
    values_.resize(signals_.size());
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      const auto part = signals[i].values.first(std::min(signals[i].values.size(), kMostJudged));
      values_[i].assign(part.begin(), part.end());
    }
    for (const DataFinding& fault : faults) {
      if (fault.fault == Fault::clock_rate) period_s /= fault.value;
      for (std::size_t i = 0; i < signals_.size(); ++i) {
        if (signals_[i].name == fault.channel) take_out(fault, period_s, values_[i]);
      }
    }
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      signals_[i].values = values_[i];
      signals_[i].deviation = standard_deviation(values_[i]);
    }
    transforms_ = transform(signals_, period_s, from_rest);
    lines_.emplace(signals_, usable, transforms_, CountedBlocks::coherent);
  }
  JudgedRecord(const JudgedRecord&) = delete;  // signals and lines refer to it
  JudgedRecord& operator=(const JudgedRecord&) = delete;

  /// Throws Cancelled after the deadline.
  double distance(const DescribedArm& arm) const {
    arm::require_time(deadline_);
    return arm ? lines_->distance_from(arm) : 1.0;
  }

 private:
  static void take_out(const DataFinding& fault, double period_s, std::vector<double>& values) {
    if (fault.fault == Fault::delay) {
      const auto late =
          std::min(values.size(), static_cast<std::size_t>(std::lround(fault.value / period_s)));
      std::shift_left(values.begin(), values.end(), static_cast<std::ptrdiff_t>(late));
      std::fill_n(values.rbegin(), late, values[values.size() - late - 1]);
      return;
    }
    for (double& value : values) value /= fault.value;
  }

  std::vector<CheckedSignal> signals_;
  std::vector<std::vector<double>> values_;
  arm::Deadline deadline_;
  Transforms transforms_;
  std::optional<RecordedLines> lines_;
};

struct Explained {
  std::vector<ArmVariation> variations;
  double distance = 1.0;
};

/// The best with one variation more; `before` where none is nearer.
Explained with_one_more(const JudgedRecord& record, const ArmVariations& arms,
                        const Explained& before) {
  Explained best = before;
  const auto take = [&](const ArmVariation& more) {
    if (!(more.size > 0.0 && more.size < 1.0)) return;
    std::vector<ArmVariation> variations = before.variations;
    variations.push_back(more);
    const double distance = record.distance(arms.with(variations));
    if (distance < best.distance) best = {std::move(variations), distance};
  };
  for (std::size_t effect = 0; effect < arms.effects; ++effect) {
    const bool is_taken = std::ranges::any_of(
        before.variations, [&](const ArmVariation& one) { return one.effect == effect; });
    if (is_taken) continue;
    for (const double size : kTriedSizes) take({effect, size});
  }
  double step = kFirstSizeStep;
  for (int i = 0; i < kSizeRefinements && best.variations.size() > before.variations.size(); ++i) {
    const ArmVariation around = best.variations.back();
    take({around.effect, around.size + step});
    take({around.effect, around.size - step});
    step *= 0.5;
  }
  return best;
}

/// A record, with the arms that are to explain it.
struct Explaining {
  const JudgedRecord& record;
  ArmVariations arms;
};

/// The arm as filed, by the simulation of its variations: distances of both are compared.
Explained as_filed(const Explaining& one) { return {{}, one.record.distance(one.arms.with({}))}; }

/// After the deadline true: what is not decided is not found.
bool explains_more(const Explaining& recorded, const Explaining& mended, bool is_sign,
                   double nearer) try {
  const Explained filed = as_filed(recorded);
  const Explained mended_filed = as_filed(mended);
  const Explained varied = with_one_more(recorded.record, recorded.arms, filed);
  if (!(varied.distance < mended_filed.distance - nearer)) return false;
  const double by_mending = filed.distance - mended_filed.distance;
  if (is_sign && filed.distance - varied.distance > kMuchMore * by_mending) return true;
  const Explained mended_varied = with_one_more(mended.record, mended.arms, mended_filed);
  return with_one_more(recorded.record, recorded.arms, varied).distance <
         mended_varied.distance - nearer;
} catch (const arm::Cancelled&) {
  return true;
}

ArmVariations variations_for(const DataCheckOptions& options, std::span<const double> torque_N_m,
                             double period_s) {
  return options.variations(torque_N_m.first(std::min(torque_N_m.size(), kMostJudged)), period_s);
}

}  // namespace

bool other_arm_explains_more(std::span<const CheckedSignal> signals,
                             const std::vector<bool>& usable, double period_s, bool from_rest,
                             const std::vector<DataFinding>& found,
                             const DataCheckOptions& options) {
  if (!options.described || !options.variations) return false;
  const JudgedRecord recorded(signals, usable, period_s, from_rest, {}, options.deadline);
  const JudgedRecord mended(signals, usable, period_s, from_rest, found, options.deadline);
  const ArmVariations variations = variations_for(options, signals[0].values, period_s);
  const bool is_scaled_torque = std::ranges::any_of(found, [](const DataFinding& one) {
    return one.fault == Fault::wrong_scale && one.channel == "torque";
  });
  const bool is_sign = std::ranges::all_of(
      found, [](const DataFinding& one) { return one.fault == Fault::sign_flipped; });
  return explains_more({recorded, variations}, {mended, variations}, is_sign,
                       is_scaled_torque ? kNearerThanScaledTorque : kNearerArm);
}

bool other_arm_explains_more(std::span<const CheckedSignal> signals,
                             const std::vector<bool>& usable, double period_s, bool from_rest,
                             const DataCheckOptions& options, const DataCheckOptions& mended) {
  if (!options.described || !options.variations || !mended.described) return false;
  const JudgedRecord recorded(signals, usable, period_s, from_rest, {}, options.deadline);
  const auto& torque_N_m = signals[0].values;
  return explains_more({recorded, variations_for(options, torque_N_m, period_s)},
                       {recorded, variations_for(mended, torque_N_m, period_s)}, false, kNearerArm);
}

}  // namespace flexarm::measured
