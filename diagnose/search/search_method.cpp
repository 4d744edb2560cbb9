#include "diagnose/ranked/ranked_selection.hpp"
#include "diagnose/search/selection.hpp"

namespace flexarm::diagnose {

Selection select(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                 const SelectionOptions& options, const DiagnosisProgress& progress) {
  const auto selected =
      options.method == SearchMethod::ranked ? ranked_selection : staged_selection;
  return selected(problem, hypotheses, options, progress);
}

}  // namespace flexarm::diagnose
