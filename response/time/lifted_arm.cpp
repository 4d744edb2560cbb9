#include "response/time/lifted_arm.hpp"

namespace flexarm::response {

using Eigen::Index;

void LiftedArm::read(const Eigen::MatrixXd& torques, std::ptrdiff_t first,
                     const Eigen::VectorXd& initial, Eigen::MatrixXd& made) const {
  const Eigen::MatrixXd read = read_in_blocks(block_, kSamples, torques, initial);
  for (Index j = 0; j < made.cols(); ++j) {
    put_readings(read.col(j), first, times_.sensors[static_cast<std::size_t>(j)].samples_later,
                 made.col(j));
  }
}

}  // namespace flexarm::response
