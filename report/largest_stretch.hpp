#pragma once

#include <cstddef>
#include <vector>

namespace flexarm::report {

/// Where the `count` neighbours begin whose sum is the largest, the first of several such; 0 where
/// there are no more than `count` values. The values are not negative.
std::size_t begin_of_largest_stretch(const std::vector<double>& values, std::size_t count);

}  // namespace flexarm::report
