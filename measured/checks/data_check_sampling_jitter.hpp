#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Sampling instants that jitter while the times that are written are even: x'(t_k) d_k in every
/// channel, with the same d_k.
///
/// Each channel is predicted from its own four samples before and after, the torque two samples
/// around and the other channels one and two samples before and after; jitter of one sample is in
/// none of them. With the residuals q, the derivatives x' per period and the covariance S of the
/// residuals, g = x'^T S^-1 x' and u = (x'^T S^-1 q)^2/g, whose mean is 1 + s^2 g with jitter of s
/// periods rms. s^2 is fitted by weighted least squares over the samples that no jump of the torque
/// shakes; its error allows for any distribution of u.
///
/// Jitter: s^2 of 4.5 standard errors or more, and s of 0.05 periods, of 0.14 where the torque is
/// made of pulses or steps: what the arm does after them is predicted less well. With a level of
/// its own for each twelfth of the record, s^2 must be 2 standard errors and s half as large.
/// A single channel needs more. Where residuals grow with g alike over all of its range, less is
/// enough.
std::vector<DataFinding> check_sampling_jitter(std::span<const CheckedSignal> signals,
                                               const std::vector<bool>& usable, double period_s);

}  // namespace flexarm::measured
