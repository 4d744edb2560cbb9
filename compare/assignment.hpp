#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::compare {

/// The column of each row in the cheapest one-to-one assignment; `cost` is n x n by rows and
/// finite. Shortest augmenting paths [JonkerVolgenant1987], O(n^3). Of equally
/// cheap ones always the same.
std::vector<std::size_t> cheapest_assignment(std::span<const double> cost, std::size_t n);

}  // namespace flexarm::compare
