#pragma once

#include "measured/modal/stabilisation.hpp"
#include "measured/modal/start_spectra.hpp"
#include "measured/modal/variable_projection.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::measured {

struct BlockSearchOptions {
  FitBand band = {};
  bool rigid = true;
  std::optional<int> modes = {};  ///< flexible blocks; empty: as many as the criterion asks for
  int most_blocks = 16;           ///< flexible ones
  double bic_margin = 10.0;       ///< a block stays when BIC falls by more
  /// Below which samples tell frequencies apart; infinite for frequency responses.
  double highest_Hz = std::numeric_limits<double>::infinity();
};

/// A number of flexible blocks that was fitted.
struct OrderTrial {
  int blocks = 0;
  double bic = 0.0;
  double frequency_Hz = 0.0;  ///< of the block added last, as fitted
  double damping_ratio = 0.0;
  bool from_chart = false;  ///< it began at a stable pole; else at a place of the search's grid
  bool kept = false;

  bool operator==(const OrderTrial&) const = default;
};

struct BlockSearch {
  BlockSet blocks;
  std::vector<OrderTrial> trials;
  std::string reason;  ///< why there are no more blocks, and how many went again
};

/// Blocks one by one: of all stable poles of the chart, then of a coarse grid of heavily damped
/// ones and of places at the ends of the band and beyond, the one that lowers the criterion most
/// with all others held is added, and all are fitted. Ends when BIC [Schwarz1978] no longer falls
/// by the margin, when nothing but rounding is left, or at the number asked for. Cost: two passes
/// of wider rows and some ten narrow ones a block.
BlockSearch search_blocks(std::span<const Stretch> stretches, std::span<const arm::Sensor> sensors,
                          std::span<const StablePole> candidates, const ColumnChoices& choices,
                          const BlockSearchOptions& options, const ProjectionOptions& projection);

}  // namespace flexarm::measured
