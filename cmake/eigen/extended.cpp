#include "cmake/eigen_decompositions.hpp"

template class Eigen::HouseholderQR<Eigen::MatrixX<long double>>;
template class Eigen::PartialPivLU<Eigen::MatrixX<long double>>;
