#include "tests/trials/clopper_pearson.hpp"

#include <boost/math/distributions/beta.hpp>

namespace flexarm::trials {

double upper_bound_95(int events, int trials) {
  if (events >= trials) return 1.0;
  return boost::math::quantile(boost::math::beta_distribution<>(events + 1.0, trials - events),
                               0.95);
}

double lower_bound_95(int events, int trials) {
  return 1.0 - upper_bound_95(trials - events, trials);
}

}  // namespace flexarm::trials
