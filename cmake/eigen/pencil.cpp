#include "cmake/eigen_decompositions.hpp"

template class Eigen::RealQZ<Eigen::MatrixXd>;
