// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace beaconless::eval {

/// The probability that a chi-square variable of `degrees_of_freedom` is below `value`.
///
/// Source: the incomplete gamma function P(dof/2, value/2) by its series below the mean and by Legendre's
/// continued fraction above (Abramowitz and Stegun, 6.5.29 and 6.5.31). Good to 1e-12 for few degrees of
/// freedom, to 1e-8 for a million.
double chi_square_probability(double value, double degrees_of_freedom);

/// The value that a chi-square variable stays below with the given probability, in (0, 1). Cost: about 60 of
/// the above.
double chi_square_quantile(double probability, double degrees_of_freedom);

}  // namespace beaconless::eval
