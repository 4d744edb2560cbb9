#include "fem/mesh.hpp"

#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace flexarm::fem {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

/// A few divisions and a sum.
constexpr double kLengthRounding = 10.0 * std::numeric_limits<double>::epsilon();

TEST(Mesh, UniformElementsAreEqual) {
  EXPECT_THAT(element_lengths({.elements = 4}, 0.96),
              Pointwise(DoubleNear(kLengthRounding), {0.25, 0.25, 0.25, 0.25}));
}

TEST(Mesh, GradedElementsGrowAwayFromTheFineEnd) {
  MeshOptions options{.elements = 3, .grading = Grading::towards_root, .grading_ratio = 2.0};
  EXPECT_THAT(element_lengths(options, 1.0),
              Pointwise(DoubleNear(kLengthRounding), {1.0 / 7, 2.0 / 7, 4.0 / 7}));
  options.grading = Grading::towards_tip;
  EXPECT_THAT(element_lengths(options, 1.0),
              Pointwise(DoubleNear(kLengthRounding), {4.0 / 7, 2.0 / 7, 1.0 / 7}));
  options.grading = Grading::towards_both;
  options.elements = 4;
  EXPECT_THAT(element_lengths(options, 1.0),
              Pointwise(DoubleNear(kLengthRounding), {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}));
}

TEST(Mesh, NodesAreTakenAsGiven) {
  EXPECT_THAT(element_lengths({.nodes_m = {0.0, 0.5, 2.0}}, 2.0),
              Pointwise(DoubleNear(kLengthRounding), {0.25, 0.75}));
}

TEST(Mesh, WhatIsNoMeshIsRefused) {
  EXPECT_THROW(element_lengths({.elements = 0}, 1.0), arm::InputError);
  EXPECT_THROW(element_lengths({.elements = kMostElements + 1}, 1.0), arm::InputError);
  EXPECT_THROW(element_lengths({.grading = Grading::towards_tip, .grading_ratio = 0.5}, 1.0),
               arm::InputError);
  EXPECT_THROW(element_lengths(
                   {.elements = 100, .grading = Grading::towards_tip, .grading_ratio = 2.0}, 1.0),
               arm::InputError);
  EXPECT_THROW(element_lengths({.nodes_m = {0.0, 0.5}}, 1.0), arm::InputError);
  EXPECT_THROW(element_lengths({.nodes_m = {0.0, 0.6, 0.4, 1.0}}, 1.0), arm::InputError);
  EXPECT_THROW(
      element_lengths({.nodes_m = {0.0, std::numeric_limits<double>::quiet_NaN(), 1.0}}, 1.0),
      arm::InputError);
}

}  // namespace
}  // namespace flexarm::fem
