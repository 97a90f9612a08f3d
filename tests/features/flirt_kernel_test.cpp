// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/flirt_kernel.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "beaconless/core/rng.hpp"

namespace beaconless {
namespace {

double sum_of(const ScaleKernel& kernel) {
  double sum = kernel.weights[0];
  for (std::size_t n = 1; n < kernel.weights.size(); ++n) sum += 2.0 * kernel.weights[n];
  return sum;
}

double variance_of(const ScaleKernel& kernel) {
  double sum = 0.0;
  for (std::size_t n = 1; n < kernel.weights.size(); ++n)
    sum += 2.0 * static_cast<double>(n * n) * kernel.weights[n];
  return sum;
}

TEST(FlirtKernel, SumsToOneAndFallsFromTheMiddle) {
  for (const FlirtKernel kind :
       {FlirtKernel::sampled_gaussian, FlirtKernel::discrete_gaussian, FlirtKernel::flirtlib_bessel})
    for (const double sigma : {0.2, 0.28, 0.5, 1.0, 1.6, 3.0, 6.1, 20.0, 50.0}) {
      const ScaleKernel kernel = make_scale_kernel(kind, sigma);
      EXPECT_NEAR(sum_of(kernel), 1.0, 1e-6) << sigma;
      for (std::size_t n = 1; n < kernel.weights.size(); ++n) {
        EXPECT_LE(kernel.weights[n], kernel.weights[n - 1]);
        EXPECT_GE(kernel.weights[n], 0.0F);
      }
    }
}

TEST(FlirtKernel, HasTheVarianceItStates) {
  // Cut at 3 sigma a Gaussian keeps 97.3 % of its variance; rounding the reach up keeps up to all of it.
  for (const FlirtKernel kind : {FlirtKernel::sampled_gaussian, FlirtKernel::discrete_gaussian})
    for (const double sigma : {1.0, 1.6, 3.0, 6.1, 20.0}) {
      const ScaleKernel kernel = make_scale_kernel(kind, sigma);
      EXPECT_DOUBLE_EQ(kernel.variance, sigma * sigma);
      EXPECT_GT(variance_of(kernel), 0.96 * kernel.variance) << sigma;
      EXPECT_LT(variance_of(kernel), 1.001 * kernel.variance) << sigma;
    }
  // flirtlib's sigma is a variance; so far out nothing is cut off.
  const ScaleKernel theirs = make_scale_kernel(FlirtKernel::flirtlib_bessel, 25.0);
  EXPECT_EQ(theirs.half_width(), 25U);
  EXPECT_NEAR(variance_of(theirs), 25.0, 0.01);
}

TEST(FlirtKernel, WeightsAreBesselFunctions) {
  // I_0(1), I_1(1), I_2(1), I_3(1): Abramowitz and Stegun, table 9.8.
  const double bessel[] = {1.266065878, 0.565159104, 0.135747670, 0.022168425};
  const ScaleKernel kernel = make_scale_kernel(FlirtKernel::discrete_gaussian, 1.0);
  ASSERT_EQ(kernel.weights.size(), 4U);
  for (std::size_t n = 1; n < 4; ++n)
    EXPECT_NEAR(kernel.weights[n] / kernel.weights[0], bessel[n] / bessel[0], 1e-6) << n;
}

TEST(FlirtKernel, AllFlirtlibScalesOfTheToolsHaveThreeTaps) {
  for (int scale = 0; scale < 5; ++scale)
    EXPECT_EQ(make_scale_kernel(FlirtKernel::flirtlib_bessel, 0.2 * std::pow(1.4, scale)).half_width(), 1U);
}

/// The definition: every sample for itself, the ends repeated.
std::vector<double> smooth_plainly(const std::vector<float>& signal, const ScaleKernel& kernel) {
  const auto last = static_cast<std::ptrdiff_t>(signal.size()) - 1;
  const auto half = static_cast<std::ptrdiff_t>(kernel.half_width());
  std::vector<double> smooth;
  for (std::ptrdiff_t i = 0; i <= last; ++i) {
    double sum = 0.0;
    for (std::ptrdiff_t n = -half; n <= half; ++n)
      sum += static_cast<double>(kernel.weights[static_cast<std::size_t>(std::abs(n))]) *
             signal[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i + n, 0, last))];
    smooth.push_back(sum);
  }
  return smooth;
}

TEST(SmoothSignal, AgreesWithItsDefinition) {
  Rng rng(7);
  std::vector<float> padded;
  for (const std::size_t size : {0U, 1U, 2U, 5U, 15U, 16U, 17U, 100U, 1081U})
    for (const double sigma : {0.2, 1.0, 6.1, 20.0}) {
      std::vector<float> signal(size);
      for (float& value : signal) value = static_cast<float>(rng.uniform(-10.0, 10.0));
      const ScaleKernel kernel = make_scale_kernel(FlirtKernel::discrete_gaussian, sigma);
      std::vector<float> smooth(size);
      smooth_signal(signal, kernel, padded, smooth);
      const std::vector<double> plain = smooth_plainly(signal, kernel);
      // Rounding of at most 121 float products of up to 10.
      for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(smooth[i], plain[i], 2e-5) << size << " " << sigma;
    }
}

TEST(SmoothSignal, LeavesAConstantAndTheMiddleOfALine) {
  std::vector<float> padded;
  std::vector<float> line(200);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = 0.5F * static_cast<float>(i);
  const ScaleKernel kernel = make_scale_kernel(FlirtKernel::discrete_gaussian, 3.0);
  std::vector<float> smooth(line.size());
  smooth_signal(line, kernel, padded, smooth);
  for (std::size_t i = kernel.half_width(); i + kernel.half_width() < line.size(); ++i)
    EXPECT_NEAR(smooth[i], line[i], 1e-4);
  const std::vector<float> constant(50, 4.0F);
  smooth.resize(50);
  smooth_signal(constant, kernel, padded, smooth);
  for (const float value : smooth) EXPECT_NEAR(value, 4.0F, 1e-6);
}

}  // namespace
}  // namespace beaconless
