#include "compare/sweeps/root_tracks.hpp"

#include "compare/assignment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace flexarm::compare {
namespace {

using Complex = std::complex<double>;

TEST(Assignment, IsAsCheapAsTheBestOfAllPermutations) {
  std::mt19937_64 random(20240501);
  std::uniform_real_distribution<double> cost_of(0.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    constexpr std::size_t kSize = 6;
    std::vector<double> cost(kSize * kSize);
    for (double& entry : cost) entry = cost_of(random);
    const auto total = [&](const std::vector<std::size_t>& columns) {
      double sum = 0.0;
      for (std::size_t i = 0; i < kSize; ++i) sum += cost[i * kSize + columns[i]];
      return sum;
    };
    std::vector<std::size_t> permutation(kSize);
    std::iota(permutation.begin(), permutation.end(), std::size_t{0});
    double best = total(permutation);
    while (std::ranges::next_permutation(permutation).found) {
      best = std::min(best, total(permutation));
    }
    const auto columns = cheapest_assignment(cost, kSize);
    EXPECT_THAT(columns, testing::UnorderedElementsAre(0, 1, 2, 3, 4, 5));
    // Sums of six numbers below 1 in another order.
    EXPECT_NEAR(total(columns), best, 1e-15);
  }
}

TEST(Assignment, OfNothingIsEmpty) {
  EXPECT_TRUE(cheapest_assignment({}, 0).empty());
}

/// A family of root lists over a place, from functions z(place), z = s^2, each real or the upper of
/// a pair; `count` smallest.
struct Family {
  std::vector<std::function<Complex(double)>> z;
  std::size_t count = 10;

  RootList operator()(double place) const {
    RootList roots;
    for (const auto& function : z) {
      const Complex value = function(place);
      if (value.imag() < 0.0 || !std::isfinite(std::abs(value))) continue;
      Complex s = std::sqrt(value);
      if (value.imag() == 0.0) {
        s = value.real() < 0.0 ? Complex(0.0, std::sqrt(-value.real()))
                               : Complex(std::sqrt(value.real()), 0.0);
      }
      roots.push_back(s);
    }
    std::ranges::sort(roots, {}, [](Complex s) { return std::abs(s); });
    if (roots.size() > count) roots.resize(count);
    return roots;
  }

  RootTracks track(int points) const {
    std::vector<RootList> at_grid;
    for (int k = 0; k < points; ++k) at_grid.push_back((*this)(k));
    return track_roots(at_grid, *this, {});
  }
};

/// The one track whose root at the first point is `s`.
const RootTrack& starting_at(const RootTracks& tracks, Complex s) {
  const auto found = std::ranges::find_if(tracks.tracks, [&](const RootTrack& track) {
    return track.first == 0 && std::abs(track.s_rad_per_s.front() - s) < 1e-9;
  });
  EXPECT_NE(found, tracks.tracks.end());
  return *found;
}

TEST(RootTracks, AnImaginaryZeroPassesRealOnesInModulus) {
  const Family family{{[](double) { return Complex(100.0); }, [](double) { return Complex(900.0); },
                       [](double p) { return Complex(-2000.0 / (1.0 + 5.0 * p)); }}};
  const auto tracks = family.track(12);
  ASSERT_EQ(tracks.tracks.size(), 3);
  const auto& moving = starting_at(tracks, {0.0, std::sqrt(2000.0)});
  ASSERT_EQ(moving.s_rad_per_s.size(), 12);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(moving.s_rad_per_s[k].real(), 0.0);
    EXPECT_NEAR(moving.s_rad_per_s[k].imag(),
                std::sqrt(2000.0 / (1.0 + 5.0 * static_cast<double>(k))), 1e-12);
  }
  EXPECT_TRUE(tracks.meetings.empty());
  EXPECT_TRUE(tracks.ambiguous.empty());
}

TEST(RootTracks, AZeroPassesThroughTheOriginFromOneAxisToTheOther) {
  const Family family{
      {[](double p) { return Complex(3.3 - p); }, [](double) { return Complex(-400.0); }}};
  const auto tracks = family.track(8);
  ASSERT_EQ(tracks.tracks.size(), 2);
  const auto& moving = starting_at(tracks, std::sqrt(3.3));
  ASSERT_EQ(moving.s_rad_per_s.size(), 8);
  EXPECT_GT(moving.s_rad_per_s[3].real(), 0.0);
  EXPECT_GT(moving.s_rad_per_s[4].imag(), 0.0);
}

TEST(RootTracks, TwoRealZerosMeetBecomeAQuadrupleAndPart) {
  // z^2 - 2 b z + c = 0 with b = 100 and c from 9000 over 11000 back to 9000.
  const auto root = [](double sign) {
    return [sign](double p) {
      const double discriminant = 1000.0 - 250.0 * p * (8.0 - p) / 2.0;
      return discriminant >= 0.0 ? Complex(100.0 + sign * std::sqrt(discriminant))
                                 : Complex(100.0, sign * std::sqrt(-discriminant));
    };
  };
  const Family family{{root(1.0), root(-1.0), [](double) { return Complex(1e4); }}};
  const auto tracks = family.track(9);
  ASSERT_EQ(tracks.tracks.size(), 3);
  for (const auto& track : tracks.tracks) EXPECT_EQ(track.s_rad_per_s.size(), 9);
  ASSERT_EQ(tracks.meetings.size(), 2);
  EXPECT_TRUE(tracks.meetings[0].to_conjugates);
  EXPECT_FALSE(tracks.meetings[1].to_conjugates);
  // The discriminant is zero where p (8 - p) = 8.
  EXPECT_LE(tracks.meetings[0].where.from, 4.0 - std::sqrt(8.0));
  EXPECT_GE(tracks.meetings[0].where.to, 4.0 - std::sqrt(8.0));
  EXPECT_LE(tracks.meetings[1].where.from, 4.0 + std::sqrt(8.0));
  EXPECT_GE(tracks.meetings[1].where.to, 4.0 + std::sqrt(8.0));
  const auto& first = tracks.tracks[tracks.meetings[0].first];
  const auto& second = tracks.tracks[tracks.meetings[0].second];
  EXPECT_EQ(first.s_rad_per_s[4], second.s_rad_per_s[4]);
  EXPECT_GT(first.s_rad_per_s[4].real() * first.s_rad_per_s[4].imag(), 0.0);
  EXPECT_TRUE(tracks.ambiguous.empty());
}

TEST(RootTracks, AZeroComesFromInfinityIntoTheList) {
  const Family family{
      {[](double) { return Complex(100.0); }, [](double) { return Complex(900.0); },
       [](double) { return Complex(2500.0); }, [](double p) { return Complex(-500.0 / p); }},
      3};
  const auto tracks = family.track(6);
  ASSERT_EQ(tracks.tracks.size(), 4);
  const auto& entering = tracks.tracks.back();
  EXPECT_EQ(entering.first, 1);
  EXPECT_EQ(entering.begin, TrackEnd::beyond);
  EXPECT_EQ(entering.end, TrackEnd::grid);
  // It passes 2500, the last in the list, at 0.2; a factor of 2 is within the edge.
  EXPECT_GE(entering.begins.to, 0.2);
  EXPECT_LE(entering.begins.from, 0.4);
  const auto& leaving = starting_at(tracks, 50.0);
  EXPECT_EQ(leaving.end, TrackEnd::beyond);
  EXPECT_EQ(leaving.s_rad_per_s.size(), 1);
}

TEST(RootTracks, ALargeStepIsHalvedUntilItIsClear) {
  // One grid step moves each root to where the next one was.
  const auto root = [](int k) { return [k](double p) { return Complex(-std::pow(2.0, k + p)); }; };
  const Family family{{root(3), root(4), root(5), root(6)}};
  const auto tracks = family.track(2);
  ASSERT_EQ(tracks.tracks.size(), 4);
  for (const auto& track : tracks.tracks) {
    ASSERT_EQ(track.s_rad_per_s.size(), 2);
    EXPECT_NEAR(std::norm(track.s_rad_per_s[1]) / std::norm(track.s_rad_per_s[0]), 2.0, 1e-12);
  }
  EXPECT_GT(tracks.further_evaluations, 0);
  EXPECT_TRUE(tracks.ambiguous.empty());
}

TEST(RootTracks, AZeroThatAModelLosesEndsItsTrackAndASecondBegins) {
  const Family family{{[](double) { return Complex(-100.0); },
                       [](double p) { return p > 2.5 && p < 4.5 ? Complex(NAN) : Complex(-400.0); },
                       [](double) { return Complex(-4000.0); }}};
  const auto tracks = family.track(8);
  ASSERT_EQ(tracks.tracks.size(), 4);
  const auto& lost = starting_at(tracks, {0.0, 20.0});
  EXPECT_EQ(lost.s_rad_per_s.size(), 3);
  EXPECT_EQ(lost.end, TrackEnd::lost);
  EXPECT_NEAR(lost.ends.to, 2.5, 1e-5);
  EXPECT_EQ(tracks.tracks.back().begin, TrackEnd::lost);
  EXPECT_EQ(tracks.tracks.back().first, 5);
}

TEST(RootTracks, NoisyRootsCostABoundedNumberOfEvaluations) {
  int calls = 0;
  std::mt19937_64 random(7);
  const auto noise = [&](double) {
    ++calls;
    std::uniform_real_distribution<double> z(1.0, 1e4);
    return RootList{{0.0, std::sqrt(z(random))}, {0.0, 200.0}};
  };
  const auto tracks = track_roots({noise(0), noise(1), noise(2)}, noise, {});
  EXPECT_LE(tracks.further_evaluations, 2 * TrackOptions{}.most_evaluations);
  EXPECT_EQ(calls, 3 + tracks.further_evaluations);
  EXPECT_FALSE(tracks.ambiguous.empty());
}

}  // namespace
}  // namespace flexarm::compare
