#include "measured/held_response.hpp"

#include <unsupported/Eigen/MatrixFunctions>

namespace flexarm::measured {

HeldResponse::HeldResponse(const SecondOrderBlock& block, double period_s, TorqueHold hold) {
  Eigen::Matrix<double, 6, 6> generator = Eigen::Matrix<double, 6, 6>::Zero();
  for (const int first : {0, 2}) {
    generator(first, first + 1) = 1.0;
    generator(first + 1, first) = -block.a0_rad2_per_s2;
    generator(first + 1, first + 1) = -block.a1_rad_per_s;
  }
  generator(3, 0) = 1.0;                                  // p'' + a1 p' + a0 p = q
  generator(1, 4) = 1.0;                                  // q'' + a1 q' + a0 q = u
  generator(4, 5) = 1.0 / period_s;                       // u grows by the second input in a period
  const Eigen::Matrix<double, 6, 6> exponential = (generator * period_s).exp();
  transition_ = exponential.topLeftCorner<4, 4>();
  now_ = exponential.block<4, 1>(0, 4);
  next_.setZero();
  if (hold == TorqueHold::first) {
    next_ = exponential.block<4, 1>(0, 5);
    now_ -= next_;
  }
}

}  // namespace flexarm::measured
