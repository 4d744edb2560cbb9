#pragma once

#include <Eigen/SparseCore>

#include <complex>
#include <memory>

namespace flexarm::fem {

/// How the rows and columns are ordered before the factorisation.
enum class PivotOrder {
  block_triangular,  ///< BTF, then AMD in each block: exact substitution where A is triangular
  natural_partial,   ///< columns as given, full partial pivoting: for narrow bands
};

/// Sparse LU factor of a square matrix by SuiteSparse's KLU
/// [DavisNatarajan2010]. `Scalar` is double or std::complex<double>. A factor serves one thread at
/// a time.
template <class Scalar>
class KluFactor {
 public:
  using Matrix = Eigen::SparseMatrix<Scalar>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  /// `matrix` is compressed. Throws std::runtime_error when memory runs out.
  KluFactor(const Matrix& matrix, PivotOrder order);
  ~KluFactor();
  KluFactor(KluFactor&&) noexcept;
  KluFactor& operator=(KluFactor&&) noexcept;

  /// A pivot was exactly zero; then `solve` must not be called.
  bool singular() const;
  /// x = A^-1 b in place.
  void solve(Vector& b) const;
  /// x = A^-T b in place, without conjugation.
  void solve_transposed(Vector& b) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

extern template class KluFactor<double>;
extern template class KluFactor<std::complex<double>>;

}  // namespace flexarm::fem
