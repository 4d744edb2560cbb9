#include "cmake/eigen_decompositions.hpp"

template class Eigen::PartialPivLU<Eigen::MatrixXcd>;
template class Eigen::JacobiSVD<Eigen::MatrixXcd>;
