#include "diagnose/symptoms/regimes.hpp"

#include "diagnose/autoregression.hpp"
#include "diagnose/evidence.hpp"
#include "diagnose/search/misfit.hpp"
#include "diagnose/search/residual_test.hpp"
#include "diagnose/symptoms/hub_motion.hpp"
#include "diagnose/symptoms/regime_bounds.hpp"
#include "diagnose/symptoms/regime_comparison.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// A quantity at each sample of a run.
using SampleValues = std::vector<double>;

/// A judged `time` run with the sums of each sample over its channels.
struct JudgedRun {
  std::size_t run = 0;  ///< index of Experiment::runs
  const measured::TimeRecord* record = nullptr;
  std::optional<HubMotion> motion = {};  ///< empty where the run does not show it
  std::vector<RelativeSquares> samples = {};
};

/// Returns the errors of the prediction of each residual of a channel from those before it, scaled
/// to their root mean square.
Eigen::VectorXd innovations_of(const Eigen::Ref<const Eigen::VectorXd>& residuals) {
  const double size = residuals.norm();
  Eigen::VectorXd made = residuals;
  if (!(size > 0.0)) return made;
  made *= std::sqrt(static_cast<double>(made.size())) / size;
  const Autoregression autoregression(made, kMostNoiseOrder);
  autoregression.whiten(made);
  made *= size / made.norm();
  return made;
}

void add_channel(const SymptomsInput& input, const ObservedChannel& channel, JudgedRun& judged) {
  const Observations& observations = input.problem.observations();
  const auto own = [&channel](const Eigen::VectorXd& all) {
    return all.segment(channel.first, channel.count).array();
  };
  const auto values = own(observations.values);
  const double signal_square = (values - values.mean()).square().mean();
  const Eigen::ArrayXd floor_square = own(observations.deviations).square() / signal_square;
  const double independent_part =
      independent(input.after.segment(channel.first, channel.count), measured::RunKind::time) /
      static_cast<double>(channel.count);
  const Eigen::VectorXd innovations =
      innovations_of(input.after.segment(channel.first, channel.count));
  std::vector<bool> counts(static_cast<std::size_t>(channel.count), true);
  for (const std::size_t k : channel.left_out) counts[k] = false;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (!counts[k]) continue;
    const auto at = static_cast<Eigen::Index>(k);
    const double noise = floor_square(at);
    const double before = own(input.before)(at);
    const double after = own(input.after)(at);
    const double innovation = innovations(at);
    judged.samples[k] += {1.0,
                          before * before * noise,
                          after * after * noise,
                          innovation * innovation * noise,
                          noise,
                          noise * noise / independent_part};
  }
}

std::vector<JudgedRun> judged_time_runs(const SymptomsInput& input) {
  const Experiment& experiment = input.problem.experiment();
  std::vector<JudgedRun> made;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    const auto* record = std::get_if<measured::TimeRecord>(&experiment.runs[r].data);
    if (record == nullptr || !input.problem.judged_runs()[r]) continue;
    JudgedRun& judged = made.emplace_back(
        JudgedRun{.run = r, .record = record, .motion = hub_motion(input.problem, r)});
    judged.samples.resize(record->time_s.size());
    for (const ObservedChannel& channel : input.problem.observations().channels) {
      if (channel.run == r) add_channel(input, channel, judged);
    }
  }
  return made;
}

SampleValues sizes(SampleValues values) {
  for (double& value : values) value = std::abs(value);
  return values;
}

/// Returns the quantity at each sample of a run; empty where the run does not show it.
SampleValues values_in(const SymptomsInput& input, const JudgedRun& judged,
                       RegimeQuantity quantity) {
  const Experiment& experiment = input.problem.experiment();
  const measured::TimeRecord& record = *judged.record;
  switch (quantity) {
    case RegimeQuantity::torque:
      // The torque is no input of an arm that is driven by motion.
      return is_driven_by_motion(experiment) ? SampleValues() : sizes(record.torque_N_m);
    case RegimeQuantity::hub_velocity:
      return judged.motion ? sizes(judged.motion->velocity_rad_per_s) : SampleValues();
    case RegimeQuantity::hub_angle:
      return judged.motion ? judged.motion->angle_rad : SampleValues();
    case RegimeQuantity::time: {
      SampleValues since_begin_s = record.time_s;
      for (double& time_s : since_begin_s) time_s -= record.time_s.front();
      return since_begin_s;
    }
    case RegimeQuantity::payload:
      return SampleValues(record.time_s.size(),
                          arm_in(experiment, experiment.runs[judged.run].run).payload.mass_kg);
    case RegimeQuantity::frequency:
      break;
  }
  return {};
}

std::vector<RegimeBounds> bounds_of(RegimeQuantity quantity,
                                    const std::vector<SampleValues>& values) {
  SampleValues all;
  for (const SampleValues& own : values) all.insert(all.end(), own.begin(), own.end());
  if (quantity == RegimeQuantity::time) return equal_parts(std::ranges::max(all));
  if (quantity != RegimeQuantity::payload) return equal_regimes(std::move(all));
  std::ranges::sort(all);
  const auto repeated = std::ranges::unique(all);
  all.erase(repeated.begin(), repeated.end());
  std::vector<RegimeBounds> made;
  for (const double mass_kg : all) made.push_back({mass_kg, mass_kg});
  return made;
}

/// Returns the sums of each regime, over so many blocks of each run.
std::vector<std::vector<RegimeBlock>> regime_blocks(const std::vector<RegimeBounds>& bounds,
                                                    const std::vector<JudgedRun>& runs,
                                                    const std::vector<SampleValues>& values,
                                                    std::size_t blocks_a_run) {
  std::vector<std::vector<RegimeBlock>> made(bounds.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::size_t count = values[r].size();
    for (std::size_t block = 0; block < blocks_a_run && count > 0; ++block) {
      std::vector<RelativeSquares> sums(bounds.size());
      const std::size_t end = (block + 1) * count / blocks_a_run;
      for (std::size_t k = block * count / blocks_a_run; k < end; ++k) {
        const auto at = std::ranges::lower_bound(bounds, values[r][k], {}, &RegimeBounds::to);
        sums[static_cast<std::size_t>(at - bounds.begin())] += runs[r].samples[k];
      }
      for (std::size_t i = 0; i < bounds.size(); ++i) {
        RegimeBlock& own = made[i].emplace_back(RegimeBlock{.run = r, .inside = sums[i]});
        for (std::size_t j = 0; j < bounds.size(); ++j) {
          if (j != i) own.outside += sums[j];
        }
      }
    }
  }
  return made;
}

/// Returns the errors in one regime, with a p-value before Bonferroni over the table.
RegimeError regime_error(RegimeQuantity quantity, const RegimeBounds& bounds,
                         const std::vector<RegimeBlock>& blocks) {
  RelativeSquares inside;
  RelativeSquares outside;
  for (const RegimeBlock& block : blocks) {
    inside += block.inside;
    outside += block.outside;
  }
  RegimeError made{.quantity = quantity,
                   .from = bounds.from,
                   .to = bounds.to,
                   .share = inside.readings / (inside.readings + outside.readings),
                   .before = std::sqrt(inside.before / inside.readings),
                   .after = std::sqrt(inside.after / inside.readings),
                   .noise_floor = std::sqrt(inside.noise / inside.readings),
                   .ratio = squares_ratio(blocks, &RelativeSquares::after, Others::of_all_runs)};
  double p_value = larger_inside_p_value(blocks, &RelativeSquares::after, Others::of_all_runs);
  if (quantity != RegimeQuantity::payload) {
    constexpr SquaresOf kInnovations = &RelativeSquares::innovations;
    made.innovation_ratio = squares_ratio(blocks, kInnovations, Others::of_the_run);
    p_value = bonferroni(
        std::min(p_value, larger_inside_p_value(blocks, kInnovations, Others::of_the_run)), 2.0);
  }
  made.p_value = std::max(p_value, inside.noise_p_value());
  return made;
}

/// Powers of a band of frequency, sums over channels.
struct BandSums {
  /// The power that the channels of one run have in the band, and how many independent numbers one
  /// of them has.
  struct RunPower {
    double power = 0.0;
    double freedom = 0.0;
  };

  std::string name;
  double from_Hz = 0.0;  ///< sum, as the other numbers
  double to_Hz = 0.0;
  double channels = 0.0;
  double lines = 0.0;  ///< parts of the channels' lines
  double before = 0.0;
  double after = 0.0;
  double noise = 0.0;
  double power = 0.0;  ///< after, without what a window leaves out of growing residuals
  std::map<std::size_t, RunPower> runs = {};

  void add(const BandError& error, double lines_of_channel) {
    from_Hz += error.band.from_Hz;
    to_Hz += error.band.to_Hz;
    channels += 1.0;
    lines += error.freedom / lines_of_channel;
    before += error.before * error.before;
    after += error.after * error.after;
    const double noise_square = error.noise * error.noise;
    const double own_power = error.power_ratio_after * noise_square;
    noise += noise_square;
    power += own_power;
    RunPower& run = runs[error.run];
    run.power += own_power;
    run.freedom = std::max(run.freedom, error.freedom);
  }
  /// Returns Satterthwaite's degrees of freedom of the sum of the runs' powers.
  double freedom() const {
    double sum = 0.0;
    double squares = 0.0;
    for (const auto& [run, own] : runs) {
      sum += own.power;
      squares += own.power * own.power / own.freedom;
    }
    return sum * sum / squares;
  }
};

std::vector<BandSums> sums_by_band(const SymptomsInput& input,
                                   const std::vector<BandError>& bands) {
  std::map<std::pair<std::size_t, std::string>, double> lines;
  for (const BandError& error : bands) lines[{error.run, error.sensor}] += error.freedom;
  std::vector<BandSums> made;
  for (const BandError& error : bands) {
    if (!input.problem.judged_runs()[error.run]) continue;
    auto at = std::ranges::find(made, error.band.name, &BandSums::name);
    if (at == made.end()) at = made.insert(at, BandSums{.name = error.band.name});
    at->add(error, lines.at({error.run, error.sensor}));
  }
  return made;
}

/// Returns the sums of all bands but one.
BandSums beside(const std::vector<BandSums>& bands, const BandSums& one) {
  BandSums made;
  for (const BandSums& band : bands) {
    if (&band == &one) continue;
    made.lines += band.lines;
    made.power += band.power;
    for (const auto& [run, own] : band.runs) {
      made.runs[run].power += own.power;
      made.runs[run].freedom += own.freedom;
    }
  }
  return made;
}

std::vector<RegimeError> frequency_regimes(const SymptomsInput& input,
                                           const std::vector<BandError>& bands) {
  const std::vector<BandSums> sums = sums_by_band(input, bands);
  std::vector<RegimeError> made;
  if (sums.size() < 2) return made;
  double channels = 0.0;
  for (const BandSums& band : sums) channels += band.lines;
  for (const BandSums& band : sums) {
    const BandSums outside = beside(sums, band);
    const double ratio = band.power / band.lines * outside.lines / outside.power;
    made.push_back(
        {.quantity = RegimeQuantity::frequency,
         .from = band.from_Hz / band.channels,
         .to = band.to_Hz / band.channels,
         .share = band.lines / channels,
         .before = std::sqrt(band.before / channels),
         .after = std::sqrt(band.after / channels),
         .noise_floor = std::sqrt(band.noise / channels),
         .ratio = ratio,
         .p_value = std::max(measured::f_tail(ratio, band.freedom(), outside.freedom()),
                             noise_probability(band.power / band.noise, band.freedom()))});
  }
  std::ranges::sort(made, {}, &RegimeError::from);
  return made;
}

}  // namespace

std::string_view to_string(RegimeQuantity quantity) {
  constexpr std::array<std::string_view, 6> kNames = {"frequency", "torque", "hub_velocity",
                                                      "hub_angle", "time",   "payload"};
  return kNames.at(static_cast<std::size_t>(quantity));
}

std::string_view unit_of(RegimeQuantity quantity) {
  constexpr std::array<std::string_view, 6> kUnits = {"Hz", "N m", "rad/s", "rad", "s", "kg"};
  return kUnits.at(static_cast<std::size_t>(quantity));
}

bool RegimeError::is_significant() const {
  return p_value < kSignificantRegime;
}

double RegimeError::excess_share() const {
  const double larger = std::max(ratio, innovation_ratio.value_or(ratio));
  if (!(larger > 1.0)) return 0.0;
  return share * (larger - 1.0) / (share * larger + 1.0 - share);
}

std::vector<RegimeError> regime_errors(const SymptomsInput& input,
                                       const std::vector<BandError>& bands) {
  std::vector<RegimeError> made = frequency_regimes(input, bands);
  const std::vector<JudgedRun> runs = judged_time_runs(input);
  constexpr auto kBlocks = static_cast<std::size_t>(kErrorBlocks);
  const std::size_t blocks_a_run = runs.empty() ? 1 : (kBlocks + runs.size() - 1) / runs.size();
  for (const RegimeQuantity quantity :
       {RegimeQuantity::torque, RegimeQuantity::hub_velocity, RegimeQuantity::hub_angle,
        RegimeQuantity::time, RegimeQuantity::payload}) {
    std::vector<SampleValues> values;
    for (const JudgedRun& run : runs) values.push_back(values_in(input, run, quantity));
    if (std::ranges::all_of(values, &SampleValues::empty)) continue;
    const std::vector<RegimeBounds> bounds = bounds_of(quantity, values);
    if (bounds.size() < 2) continue;
    // A run has one payload, and its blocks tell nothing of how runs differ.
    const std::size_t blocks = quantity == RegimeQuantity::payload ? 1 : blocks_a_run;
    const auto sums = regime_blocks(bounds, runs, values, blocks);
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      made.push_back(regime_error(quantity, bounds[i], sums[i]));
    }
  }
  const auto tests = static_cast<double>(made.size());
  for (RegimeError& regime : made) regime.p_value = bonferroni(regime.p_value, tests);
  return made;
}

}  // namespace flexarm::diagnose
