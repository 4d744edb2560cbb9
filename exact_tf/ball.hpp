#pragma once

// Private to exact_tf: thin owners of Arb's balls, with operators. Not installed.

#include <acb.h>
#include <arb.h>

#include <complex>
#include <optional>
#include <utility>

namespace flexarm::exact_tf::ball {

/// Working precision of every operator below, in bits, for the current thread and scope.
class Precision {
 public:
  explicit Precision(long bits) : outer_(std::exchange(bits_, bits)) {}
  ~Precision() { bits_ = outer_; }
  Precision(const Precision&) = delete;
  Precision& operator=(const Precision&) = delete;

  static long bits() { return bits_; }

 private:
  static inline thread_local long bits_ = 128;
  long outer_;
};

/// A real ball: every result contains every value that the operands allow.
class RealBall {
 public:
  RealBall() { arb_init(x_); }
  RealBall(double exact) : RealBall() { arb_set_d(x_, exact); }
  RealBall(int exact) : RealBall() { arb_set_si(x_, exact); }
  RealBall(const RealBall& other) : RealBall() { arb_set(x_, other.x_); }
  RealBall(RealBall&& other) noexcept : RealBall() { arb_swap(x_, other.x_); }
  RealBall& operator=(RealBall other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }
  ~RealBall() { arb_clear(x_); }

  arb_ptr get() { return x_; }
  arb_srcptr get() const { return x_; }

  static RealBall pi() {
    RealBall result;
    arb_const_pi(result.x_, Precision::bits());
    return result;
  }

  /// [low, high] as one ball.
  static RealBall hull(const RealBall& low, const RealBall& high) {
    RealBall result;
    arb_union(result.x_, low.x_, high.x_, Precision::bits());
    return result;
  }

  /// +1 or -1 where the whole ball lies on one side of zero, else 0.
  int sign() const { return arb_is_positive(x_) ? 1 : arb_is_negative(x_) ? -1 : 0; }

  /// The one integer in the ball; empty where there is none or more than one.
  std::optional<long> unique_integer() const {
    fmpz_t integer;
    fmpz_init(integer);
    std::optional<long> result;
    if (arb_get_unique_fmpz(integer, x_) && fmpz_fits_si(integer)) result = fmpz_get_si(integer);
    fmpz_clear(integer);
    return result;
  }

  RealBall midpoint() const {
    RealBall result;
    arb_get_mid_arb(result.x_, x_);
    return result;
  }
  double nearest_double() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }

  /// An exact number that no value of the ball exceeds.
  RealBall upper_end() const {
    RealBall result;
    arb_get_ubound_arf(arb_midref(result.x_), x_, Precision::bits());
    return result;
  }
  /// A double that no value of the ball exceeds.
  double upper_bound() const { return arf_get_d(arb_midref(upper_end().x_), ARF_RND_CEIL); }

  bool is_below(const RealBall& other) const { return arb_lt(x_, other.x_) != 0; }

  friend RealBall operator-(const RealBall& a) {
    RealBall result;
    arb_neg(result.x_, a.x_);
    return result;
  }
  friend RealBall operator+(const RealBall& a, const RealBall& b) {
    RealBall result;
    arb_add(result.x_, a.x_, b.x_, Precision::bits());
    return result;
  }
  friend RealBall operator-(const RealBall& a, const RealBall& b) {
    RealBall result;
    arb_sub(result.x_, a.x_, b.x_, Precision::bits());
    return result;
  }
  friend RealBall operator*(const RealBall& a, const RealBall& b) {
    RealBall result;
    arb_mul(result.x_, a.x_, b.x_, Precision::bits());
    return result;
  }
  friend RealBall operator/(const RealBall& a, const RealBall& b) {
    RealBall result;
    arb_div(result.x_, a.x_, b.x_, Precision::bits());
    return result;
  }
  friend RealBall sqrt(const RealBall& a) {
    RealBall result;
    arb_sqrt(result.x_, a.x_, Precision::bits());
    return result;
  }
  friend RealBall exp(const RealBall& a) {
    RealBall result;
    arb_exp(result.x_, a.x_, Precision::bits());
    return result;
  }
  friend RealBall floor(const RealBall& a) {
    RealBall result;
    arb_floor(result.x_, a.x_, Precision::bits());
    return result;
  }
  friend void sin_cos(RealBall& sine, RealBall& cosine, const RealBall& a) {
    arb_sin_cos(sine.x_, cosine.x_, a.x_, Precision::bits());
  }

 private:
  arb_t x_;
};

/// A complex ball, a rectangle; real values are held and multiplied as such.
class ComplexBall {
 public:
  ComplexBall() { acb_init(z_); }
  ComplexBall(int exact) : ComplexBall() { acb_set_si(z_, exact); }
  ComplexBall(const RealBall& real) : ComplexBall() { acb_set_arb(z_, real.get()); }
  ComplexBall(const RealBall& real, const RealBall& imaginary) : ComplexBall() {
    acb_set_arb_arb(z_, real.get(), imaginary.get());
  }
  ComplexBall(const ComplexBall& other) : ComplexBall() { acb_set(z_, other.z_); }
  ComplexBall(ComplexBall&& other) noexcept : ComplexBall() { acb_swap(z_, other.z_); }
  ComplexBall& operator=(ComplexBall other) noexcept {
    acb_swap(z_, other.z_);
    return *this;
  }
  ~ComplexBall() { acb_clear(z_); }

  /// e^{i pi t}.
  static ComplexBall unit_at_half_turns(const RealBall& t) {
    ComplexBall result;
    acb_set_arb(result.z_, t.get());
    acb_exp_pi_i(result.z_, result.z_, Precision::bits());
    return result;
  }

  RealBall real() const {
    RealBall result;
    arb_set(result.get(), acb_realref(z_));
    return result;
  }
  RealBall imag() const {
    RealBall result;
    arb_set(result.get(), acb_imagref(z_));
    return result;
  }
  ComplexBall midpoint() const {
    ComplexBall result;
    acb_get_mid(result.z_, z_);
    return result;
  }
  std::complex<double> nearest_double() const {
    return {real().nearest_double(), imag().nearest_double()};
  }
  bool contains_zero() const { return acb_contains_zero(z_) != 0; }
  bool overlaps(const ComplexBall& other) const { return acb_overlaps(z_, other.z_) != 0; }

  friend ComplexBall operator-(const ComplexBall& a) {
    ComplexBall result;
    acb_neg(result.z_, a.z_);
    return result;
  }
  friend ComplexBall operator+(const ComplexBall& a, const ComplexBall& b) {
    ComplexBall result;
    acb_add(result.z_, a.z_, b.z_, Precision::bits());
    return result;
  }
  friend ComplexBall operator-(const ComplexBall& a, const ComplexBall& b) {
    ComplexBall result;
    acb_sub(result.z_, a.z_, b.z_, Precision::bits());
    return result;
  }
  friend ComplexBall operator*(const ComplexBall& a, const ComplexBall& b) {
    ComplexBall result;
    acb_mul(result.z_, a.z_, b.z_, Precision::bits());
    return result;
  }
  friend ComplexBall operator/(const ComplexBall& a, const ComplexBall& b) {
    ComplexBall result;
    acb_div(result.z_, a.z_, b.z_, Precision::bits());
    return result;
  }
  friend ComplexBall exp(const ComplexBall& a) {
    ComplexBall result;
    acb_exp(result.z_, a.z_, Precision::bits());
    return result;
  }
  friend ComplexBall sqrt(const ComplexBall& a) {
    ComplexBall result;
    acb_sqrt(result.z_, a.z_, Precision::bits());
    return result;
  }
  friend void sin_cos(ComplexBall& sine, ComplexBall& cosine, const ComplexBall& a) {
    acb_sin_cos(sine.z_, cosine.z_, a.z_, Precision::bits());
  }
  friend RealBall abs(const ComplexBall& a) {
    RealBall result;
    acb_abs(result.get(), a.z_, Precision::bits());
    return result;
  }
  friend RealBall arg(const ComplexBall& a) {
    RealBall result;
    acb_arg(result.get(), a.z_, Precision::bits());
    return result;
  }

 private:
  acb_t z_;
};

}  // namespace flexarm::exact_tf::ball
