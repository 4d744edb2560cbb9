#pragma once

#include <acb.h>
#include <acb_mat.h>

#include <complex>

namespace flexarm::exact_tf {

/// A complex ball of Arb with the operators that a formula needs, as a judge in tests. Working
/// precision is a setting of the thread, in bits.
class Ball {
 public:
  inline static thread_local slong precision_bits = 1024;

  Ball() { acb_init(value_); }
  Ball(double x) : Ball() { acb_set_d(value_, x); }
  Ball(std::complex<double> x) : Ball() { acb_set_d_d(value_, x.real(), x.imag()); }
  /// Exact: a long double is the sum of two doubles here.
  Ball(std::complex<long double> x) : Ball() {
    const std::complex<double> high(static_cast<double>(x.real()), static_cast<double>(x.imag()));
    const std::complex<double> low(static_cast<double>(x.real() - high.real()),
                                   static_cast<double>(x.imag() - high.imag()));
    acb_add(value_, Ball(high).value_, Ball(low).value_, precision_bits);
  }
  Ball(long double x) : Ball(std::complex<long double>(x)) {}
  Ball(const Ball& other) : Ball() { acb_set(value_, other.value_); }
  Ball& operator=(const Ball& other) {
    acb_set(value_, other.value_);
    return *this;
  }
  ~Ball() { acb_clear(value_); }

  acb_ptr get() { return value_; }
  acb_srcptr get() const { return value_; }

  friend Ball operator+(const Ball& a, const Ball& b) { return apply(acb_add, a, b); }
  friend Ball operator-(const Ball& a, const Ball& b) { return apply(acb_sub, a, b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return apply(acb_mul, a, b); }
  friend Ball operator/(const Ball& a, const Ball& b) { return apply(acb_div, a, b); }
  Ball operator-() const { return Ball(0.0) - *this; }

  friend Ball exp(const Ball& a) { return apply(acb_exp, a); }
  friend Ball sin(const Ball& a) { return apply(acb_sin, a); }
  friend Ball cos(const Ball& a) { return apply(acb_cos, a); }
  friend Ball sinh(const Ball& a) { return apply(acb_sinh, a); }
  friend Ball cosh(const Ball& a) { return apply(acb_cosh, a); }
  friend Ball sqrt(const Ball& a) { return apply(acb_sqrt, a); }

  /// Upper bound of |a|.
  friend double upper_bound(const Ball& a) {
    mag_t bound;
    mag_init(bound);
    acb_get_mag(bound, a.value_);
    const double result = mag_get_d(bound);
    mag_clear(bound);
    return result;
  }
  std::complex<double> midpoint() const {
    return {arf_get_d(arb_midref(acb_realref(value_)), ARF_RND_NEAR),
            arf_get_d(arb_midref(acb_imagref(value_)), ARF_RND_NEAR)};
  }

 private:
  template <class Function>
  static Ball apply(Function function, const Ball& a) {
    Ball result;
    function(result.value_, a.value_, precision_bits);
    return result;
  }
  template <class Function>
  static Ball apply(Function function, const Ball& a, const Ball& b) {
    Ball result;
    function(result.value_, a.value_, b.value_, precision_bits);
    return result;
  }

  acb_t value_;
};

/// |a - b|/|b|, an upper bound.
inline double relative_distance(const Ball& a, const Ball& b) {
  return upper_bound((a - b) / b);
}

}  // namespace flexarm::exact_tf
