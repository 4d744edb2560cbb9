#include "diagnose/symptoms/regime_comparison.hpp"

#include "diagnose/symptoms/band_errors.hpp"
#include "diagnose/unknown/jackknife.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexarm::diagnose {

namespace {

/// Returns how many blocks with equally many readings vary as much: (sum n)^2/sum n^2.
double filled_blocks(std::span<const RegimeBlock> blocks, RelativeSquares RegimeBlock::*part) {
  double sum = 0.0;
  double squares = 0.0;
  for (const RegimeBlock& block : blocks) {
    const double readings = (block.*part).readings;
    sum += readings;
    squares += readings * readings;
  }
  return sum * sum / squares;
}

/// Returns Welch's degrees of freedom of a difference between means over so many blocks. They share
/// their blocks, so that it is less than `blocks`.
double welch_freedom(double inside, double outside, double blocks) {
  const double variance = 1.0 / inside + 1.0 / outside;
  const double freedom =
      variance * variance /
      (1.0 / (inside * inside * (inside - 1.0)) + 1.0 / (outside * outside * (outside - 1.0)));
  return std::min(freedom, blocks - 1.0);
}

}  // namespace

RelativeSquares& RelativeSquares::operator+=(const RelativeSquares& other) {
  readings += other.readings;
  before += other.before;
  after += other.after;
  innovations += other.innovations;
  noise += other.noise;
  noise_variance += other.noise_variance;
  return *this;
}

double RelativeSquares::noise_p_value() const {
  return noise_probability(after / noise, noise * noise / noise_variance);
}

double squares_ratio(std::span<const RegimeBlock> blocks, SquaresOf squares, Others others) {
  double sum = 0.0;
  double expected = 0.0;
  for (std::size_t from = 0, to = 0; from < blocks.size(); from = to) {
    RelativeSquares inside;
    RelativeSquares outside;
    const auto is_compared = [&](const RegimeBlock& block) {
      return others == Others::of_all_runs || block.run == blocks[from].run;
    };
    for (; to < blocks.size() && is_compared(blocks[to]); ++to) {
      inside += blocks[to].inside;
      outside += blocks[to].outside;
    }
    if (!(outside.readings > 0.0)) continue;
    sum += inside.*squares;
    expected += inside.readings * (outside.*squares / outside.readings);
  }
  return sum / expected;
}

double larger_inside_p_value(std::span<const RegimeBlock> blocks, SquaresOf squares,
                             Others others) {
  std::vector<double> without_one;
  for (std::size_t left_out = 0; left_out < blocks.size(); ++left_out) {
    std::vector<RegimeBlock> rest(blocks.begin(), blocks.end());
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
    without_one.push_back(std::log(squares_ratio(rest, squares, others)));
  }
  const double t =
      std::log(squares_ratio(blocks, squares, others)) / jackknife_std_error(without_one);
  if (!(t > 0.0)) return 1.0;
  const double freedom = welch_freedom(filled_blocks(blocks, &RegimeBlock::inside),
                                       filled_blocks(blocks, &RegimeBlock::outside),
                                       static_cast<double>(blocks.size()));
  return 0.5 * measured::students_t_tails(t, freedom);
}

}  // namespace flexarm::diagnose
