// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/chi_square.hpp"

#include <cmath>
#include <limits>

namespace beaconless::eval {
namespace {

constexpr double kEnough = 1e-15;
constexpr int kMostTerms = 100'000;  // sqrt(a) terms and some are enough; only absurd arguments come this far

/// x^a e^-x / Gamma(a), without overflow.
double front_factor(double a, double x) { return std::exp(a * std::log(x) - x - std::lgamma(a)); }

/// P(a, x) for x below a + 1.
double by_series(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (int n = 1; n < kMostTerms && term > kEnough * sum; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return front_factor(a, x) * sum;
}

/// 1 - P(a, x) for x above a + 1; Lentz's way to a continued fraction.
double by_fraction(double a, double x) {
  double b = x + 1.0 - a;
  double c = std::numeric_limits<double>::max();
  double d = 1.0 / b;
  double fraction = d;
  for (int n = 1; n < kMostTerms; ++n) {
    const double numerator = -n * (n - a);
    b += 2.0;
    d = 1.0 / (numerator * d + b);
    c = b + numerator / c;
    fraction *= c * d;
    if (std::abs(c * d - 1.0) < kEnough) break;
  }
  return front_factor(a, x) * fraction;
}

}  // namespace

double chi_square_probability(double value, double degrees_of_freedom) {
  if (!(value > 0.0) || !(degrees_of_freedom > 0.0)) return 0.0;
  const double a = 0.5 * degrees_of_freedom;
  const double x = 0.5 * value;
  return x < a + 1.0 ? by_series(a, x) : 1.0 - by_fraction(a, x);
}

double chi_square_quantile(double probability, double degrees_of_freedom) {
  double low = 0.0;
  double high = degrees_of_freedom + 10.0;
  while (chi_square_probability(high, degrees_of_freedom) < probability && high < 1e12) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_square_probability(middle, degrees_of_freedom) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace beaconless::eval
