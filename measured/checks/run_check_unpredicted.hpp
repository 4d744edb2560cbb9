#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace flexarm::measured {

/// What the samples around do not predict of a channel, as the noise of one sample.
struct UnpredictedNoise {
  double most = 0.0;     ///< an upper bound: what is left may be motion
  double certain = 0.0;  ///< of noise for certain; 0: none is
};

/// In standard deviations of the signal `self` of `values`, which are `standardised` and of one
/// length. A sample is predicted from those before and after it, fewer and more of them, and from
/// the other usable signals around. White noise of the channel leaves a normal residual whose
/// spectrum is that of the prediction's filter 1 - S(omega), and more samples hardly predict more
/// of it. Where all of this holds the residual is noise.
UnpredictedNoise unpredicted_noise(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                                   const std::vector<bool>& usable);

}  // namespace flexarm::measured
