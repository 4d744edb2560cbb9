#include "diagnose/search/minimise.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace flexarm::diagnose {
namespace {

/// The sum of squares of a function of a candidate's nuisances, which have no bounds.
class OfNuisances final : public Objective {
 public:
  using Function = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

  explicit OfNuisances(Function function) : function_(std::move(function)) {}

  std::optional<Eigen::VectorXd> lines_of(const Candidate& candidate) const override {
    ++calls_;
    return function_(candidate.coordinates());
  }
  double cost(const Eigen::VectorXd& lines) const override { return lines.squaredNorm(); }
  Eigen::VectorXd weights(const Eigen::VectorXd& lines) const override {
    return Eigen::VectorXd::Ones(lines.size());
  }
  int calls() const { return calls_; }

 private:
  Function function_;
  mutable std::atomic<int> calls_ = 0;
};

Minimum minimum(const OfNuisances& objective, std::vector<double> start, double tolerance = 1e-7) {
  const ReportedWork work({});
  return minimise(objective, {.nuisances = std::move(start)}, work,
                  {.most_steps = 200, .tolerance = 0.0, .relative_tolerance = tolerance});
}

/// Residuals of a decay with three unknown numbers, which are 0.6, 0.3 and 0.2, and a rest that no
/// such numbers leave out, of this size.
OfNuisances decay(double rest) {
  return OfNuisances([rest](const Eigen::VectorXd& places) {
    const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(200, 0.0, 4.0);
    const auto model = [&](double a, double rate, double offset) {
      return Eigen::ArrayXd(a * (-10.0 * rate * t).exp() + offset);
    };
    const auto truth = model(0.6, 0.3, 0.2);
    return Eigen::VectorXd(
        (model(places(0), places(1), places(2)) - truth + rest * (40.0 * t).sin()).matrix());
  });
}

/// The part of the squares of the lines along the derivatives: 0 at a minimum.
double part_along(const Minimum& found) {
  const Eigen::VectorXd turned =
      Eigen::HouseholderQR<Eigen::MatrixXd>(found.jacobian).householderQ().adjoint() * found.lines;
  return turned.head(found.jacobian.cols()).squaredNorm() / found.lines.squaredNorm();
}

TEST(Minimise, EndsAtAMinimumByDifferenceQuotients) {
  for (const double rest : {1e-3, 0.1}) {
    const Minimum found = minimum(decay(rest), {0.4, 0.6, 0.4});
    EXPECT_TRUE(found.converged) << rest;
    // The error of a difference quotient over 1e-4 of a place adds to the tolerance.
    EXPECT_LE(part_along(found), 1e-6) << rest;
  }
}

TEST(Minimise, SecantsSaveMostDifferenceQuotients) {
  const OfNuisances objective = decay(1e-3);
  const Minimum found = minimum(objective, {0.5, 0.35, 0.3});
  EXPECT_EQ(found.evaluations, objective.calls());
  // By difference quotients alone four evaluations for each of some five steps, and the derivatives
  // at the end.
  EXPECT_LE(found.evaluations, 18);
}

// The valley turns: secants mislead there.
TEST(Minimise, FollowsABentValley) {
  const OfNuisances valley([](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(Eigen::Vector2d(10.0 * (x(1) - x(0) * x(0)), 1.0 - x(0)));
  });
  const Minimum found = minimum(valley, {-1.2, 1.0}, 1e-12);
  EXPECT_NEAR(found.candidate.nuisances[0], 1.0, 1e-6);
  EXPECT_NEAR(found.candidate.nuisances[1], 1.0, 1e-6);
}

TEST(Minimise, IsNotPossibleWhereTheStartIsNot) {
  class Impossible final : public Objective {
   public:
    std::optional<Eigen::VectorXd> lines_of(const Candidate&) const override { return {}; }
    double cost(const Eigen::VectorXd&) const override { return 0.0; }
    Eigen::VectorXd weights(const Eigen::VectorXd& lines) const override { return lines; }
  };
  const ReportedWork work({});
  const Minimum found = minimise(Impossible{}, {.nuisances = {0.5}}, work);
  EXPECT_FALSE(found.is_possible());
  EXPECT_FALSE(found.converged);
}

}  // namespace
}  // namespace flexarm::diagnose
