#include "report/largest_stretch.hpp"

#include <iterator>
#include <numeric>

namespace flexarm::report {

std::size_t begin_of_largest_stretch(const std::vector<double>& values, std::size_t count) {
  std::vector<double> sums = {0.0};
  std::partial_sum(values.begin(), values.end(), std::back_inserter(sums));
  std::size_t largest = 0;
  for (std::size_t k = 0; k + count <= values.size(); ++k) {
    if (sums[k + count] - sums[k] > sums[largest + count] - sums[largest]) largest = k;
  }
  return largest;
}

}  // namespace flexarm::report
