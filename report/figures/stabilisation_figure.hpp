#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/modal/stabilisation.hpp"
#include "report/figures/figure.hpp"

#include <optional>
#include <string>
#include <vector>

namespace flexarm::report {

/// A magnitude over frequency, of which the course alone counts.
struct MeanResponse {
  std::vector<double> frequency_Hz;  ///< ascending
  std::vector<double> magnitude;     ///< above 0; others are gaps
};

/// The geometric mean over all channels of |response|, at the frequencies of the first; of other
/// channels interpolated between theirs (log |response| over frequency), NaN outside of them. Of
/// channels of unlike units it is a mean of courses.
MeanResponse mean_response(const measured::FrequencyRecord& record);

struct StabilisationPlot {
  std::string title = {};
  std::optional<MeanResponse> background = {};  ///< drawn over the chart's height, logarithmically
  std::vector<double> fitted_poles_Hz = {};     ///< lines, with their frequencies on top
};

/// The chart: poles over frequency, the order of the model upwards, with a symbol for what is
/// stable.
///
/// Throws std::invalid_argument for a chart without a pole in its band.
Figure stabilisation_figure(const measured::StabilisationChart& chart,
                            const StabilisationPlot& plot = {});

}  // namespace flexarm::report
