#pragma once

#include "diagnose/search/likelihood.hpp"
#include "diagnose/search/problem.hpp"

#include <cstddef>

namespace flexarm::diagnose {

/// The first samples of each `time` run of a problem for estimation, simulated with a few flexible
/// modes. The noise is that of the whole runs: a short part shows it less well. Lines of responses
/// are thinned; modal tables are whole.
class PartOfData {
 public:
  PartOfData(const Problem& whole, std::size_t samples, int most_modes);

  PartOfData(const PartOfData&) = delete;
  PartOfData& operator=(const PartOfData&) = delete;
  PartOfData(PartOfData&&) = delete;
  PartOfData& operator=(PartOfData&&) = delete;
  ~PartOfData() = default;

  /// Returns the likelihood of the part, whose simulation errs by the modes that the whole has
  /// beside.
  const Likelihood& likelihood() const { return likelihood_; }

 private:
  Problem problem_;
  Likelihood likelihood_;
};

}  // namespace flexarm::diagnose
