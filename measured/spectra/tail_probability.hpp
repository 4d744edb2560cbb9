#pragma once

namespace flexarm::measured {

/// Probabilities that a statistic of noise alone is as large as `value` or larger, by its law. 0 of
/// an infinite one, 1 of one at or below 0. 1 of NaN, for it shows nothing, and where a number of
/// degrees of freedom is NaN or not above 0. Where NaN speaks against noise the caller says so.
double chi_squared_tail(double value, double freedom);
/// `lambda` is the noncentrality.
double chi_squared_tail(double value, double freedom, double lambda);
double f_tail(double value, double freedom, double freedom_of_noise);

/// The same of |value| on either side of 0.
double normal_tails(double value);
double students_t_tails(double value, double freedom);

}  // namespace flexarm::measured
