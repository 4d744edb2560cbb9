#pragma once

namespace flexarm::exact_tf {

/// What the functions of frequency are evaluated in. `extended` is long double: results are within
/// an ulp or so of a double. `working` is double, for the thousands of evaluations of a fit: at the
/// lowest sixteen modes and at frequencies up to those relative errors are below 1e-11, and it
/// takes a fifth of the time.
enum class Arithmetic { extended, working };

}  // namespace flexarm::exact_tf
