#include "cmake/eigen_decompositions.hpp"

template class Eigen::RealQZ<Eigen::MatrixXd>;
template class Eigen::GeneralizedEigenSolver<Eigen::MatrixXd>;
