#include "diagnose/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace flexarm::diagnose {
namespace {

TEST(InParallel, DoesEachOnce) {
  std::vector<int> done(1000, 0);
  in_parallel(done.size(), [&](std::size_t i) { ++done[i]; });
  EXPECT_EQ(done, std::vector<int>(1000, 1));
}

// What oneTBB does with nested work that is bound to cancelled work: it leaves it undone.
TEST(InParallel, FinishesWorkWithinWorkThatIsCancelled) {
  constexpr std::size_t kInner = 100;
  std::atomic<std::size_t> begun = 0;
  std::atomic<std::size_t> finished = 0;
  EXPECT_THROW(in_parallel(1000,
                           [&](std::size_t i) {
                             if (i % 10 == 3) throw std::runtime_error("cancelled");
                             ++begun;
                             std::atomic<std::size_t> done = 0;
                             in_parallel(kInner, [&](std::size_t) { ++done; });
                             if (done == kInner) ++finished;
                           }),
               std::runtime_error);
  EXPECT_EQ(begun, finished);
}

TEST(InParallel, PassesAnExceptionOfInnerWorkOn) {
  EXPECT_THROW(in_parallel(4,
                           [](std::size_t) {
                             in_parallel(4, [](std::size_t i) {
                               if (i == 2) throw std::runtime_error("inner");
                             });
                           }),
               std::runtime_error);
}

}  // namespace
}  // namespace flexarm::diagnose
