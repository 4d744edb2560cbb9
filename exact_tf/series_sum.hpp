#pragma once

#include "exact_tf/scaled.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace flexarm::exact_tf {

template <class R>
inline constexpr R kNegligibleTerm = std::numeric_limits<R>::epsilon() / 100;

/// Terms of exp(size) that are not negligible.
template <class R>
int likely_terms(R size) {
  int n = 1;
  for (R term = size; term > kNegligibleTerm<R>; term *= size / static_cast<R>(n)) ++n;
  return n;
}

/// Sum of a series of arrays whose terms `recursion` yields in turn, until four in a row no longer
/// change any component (the beam's equations link each component with itself after four terms).
/// The first `likely` are not examined. `take(n, term)` is given each from n = 1 on.
template <class Recursion, class Take>
auto sum_series(Recursion& recursion, int likely, Take take) {
  constexpr int kPeriod = 4;
  constexpr int kMostTerms = 400;
  auto sum = recursion.term();
  using R = RealOf<typename decltype(sum)::value_type>;
  int negligible = 0;
  for (int n = 1; negligible < kPeriod; ++n) {
    if (n > kMostTerms) throw std::logic_error("segment too long for its power series");
    recursion.advance();
    const auto& term = recursion.term();
    take(n, term);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += term[i];
    if (n < likely) continue;
    bool changes = false;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      changes = changes || rough_size(term[i]) > kNegligibleTerm<R> * rough_size(sum[i]);
    }
    negligible = changes ? 0 : negligible + 1;
  }
  return sum;
}

}  // namespace flexarm::exact_tf
