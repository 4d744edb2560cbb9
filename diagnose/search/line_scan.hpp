#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace flexarm::diagnose {

/// Residuals at value number i; empty where they cannot be computed.
using ResidualsAtValue = std::function<std::optional<Eigen::VectorXd>(int)>;

/// Of the values 0 to `count` - 1 of one parameter, in their order, that at which |r| is least.
///
/// |r| is formed at as few of them as its course allows. Between two values the course is bounded
/// by its chord: with e the distance of the value in their middle from the chord of an interval,
/// that of its halves is e/4 where the course is smooth, and e/2 is allowed for. An interval within
/// which |r| is then larger than at the best value is not looked at further. Where e is more than
/// a quarter of the chord, the course is not resolved (the phase of a mode has turned over), and
/// nothing is known of what lies between.
int least_on_line(const ResidualsAtValue& residuals, int count);

}  // namespace flexarm::diagnose
