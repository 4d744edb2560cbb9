#include "fem/klu_factor.hpp"

#include <klu.h>

#include <stdexcept>
#include <type_traits>

namespace flexarm::fem {

template <class Scalar>
struct KluFactor<Scalar>::Parts {
  static constexpr bool kComplex = !std::is_same_v<Scalar, double>;

  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;

  ~Parts() {
    if (numeric != nullptr) klu_free_numeric(&numeric, &common);
    if (symbolic != nullptr) klu_free_symbolic(&symbolic, &common);
  }
};

template <class Scalar>
KluFactor<Scalar>::KluFactor(const Matrix& matrix, PivotOrder order)
    : parts_(std::make_unique<Parts>()) {
  klu_common& common = parts_->common;
  klu_defaults(&common);
  common.scale = 0;  // the callers' equations are of one size by their choice of coordinates
  if (order == PivotOrder::natural_partial) {
    common.btf = 0;
    common.ordering = 2;
    common.tol = 1.0;
  }
  // KLU takes its inputs by pointers to non-const and does not modify them.
  const int n = static_cast<int>(matrix.rows());
  int* columns = const_cast<int*>(matrix.outerIndexPtr());
  int* rows = const_cast<int*>(matrix.innerIndexPtr());
  auto* values = reinterpret_cast<double*>(const_cast<Scalar*>(matrix.valuePtr()));
  parts_->symbolic = klu_analyze(n, columns, rows, &common);
  if (parts_->symbolic != nullptr) {
    if constexpr (Parts::kComplex) {
      parts_->numeric = klu_z_factor(columns, rows, values, parts_->symbolic, &common);
    } else {
      parts_->numeric = klu_factor(columns, rows, values, parts_->symbolic, &common);
    }
  }
  if (common.status < KLU_OK) throw std::runtime_error("sparse LU: out of memory");
}

template <class Scalar>
KluFactor<Scalar>::~KluFactor() = default;
template <class Scalar>
KluFactor<Scalar>::KluFactor(KluFactor&&) noexcept = default;
template <class Scalar>
KluFactor<Scalar>& KluFactor<Scalar>::operator=(KluFactor&&) noexcept = default;

template <class Scalar>
bool KluFactor<Scalar>::singular() const {
  return parts_->common.status == KLU_SINGULAR;
}

template <class Scalar>
void KluFactor<Scalar>::solve(Vector& b) const {
  const int n = static_cast<int>(b.size());
  auto* values = reinterpret_cast<double*>(b.data());
  if constexpr (Parts::kComplex) {
    klu_z_solve(parts_->symbolic, parts_->numeric, n, 1, values, &parts_->common);
  } else {
    klu_solve(parts_->symbolic, parts_->numeric, n, 1, values, &parts_->common);
  }
}

template <class Scalar>
void KluFactor<Scalar>::solve_transposed(Vector& b) const {
  const int n = static_cast<int>(b.size());
  auto* values = reinterpret_cast<double*>(b.data());
  if constexpr (Parts::kComplex) {
    klu_z_tsolve(parts_->symbolic, parts_->numeric, n, 1, values, 0, &parts_->common);
  } else {
    klu_tsolve(parts_->symbolic, parts_->numeric, n, 1, values, &parts_->common);
  }
}

template class KluFactor<double>;
template class KluFactor<std::complex<double>>;

}  // namespace flexarm::fem
