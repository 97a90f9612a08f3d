// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

namespace beaconless {

/// A robust criterion on whitened residuals u = r / sigma.
///
/// `rho(u²)` is the cost, `weight(u²)` = rho'(u) / u is what a re-weighted least-squares step multiplies
/// with; weight(0) = 1 and weights never grow. Scales are in sigmas. Source: dissertation 2.3.1; Bergström
/// and Edlund, "Robust registration of point sets using iteratively reweighted least squares", 2014. Differs:
/// the dissertation feeds metres, with which its constants reject nothing; its Tukey cost beyond k is Huber's
/// (correct: k²/6) and its Welsch cost is Cauchy's (correct: (k²/2)(1 - exp(-u²/k²))). Its weights are right.
template <class Loss>
concept RobustLoss = requires(const Loss& loss, double squared) {
  { loss.rho(squared) } -> std::same_as<double>;
  { loss.weight(squared) } -> std::same_as<double>;
  { loss.curvature(squared) } -> std::same_as<double>;
  { Loss::kEfficient95 } -> std::convertible_to<double>;
  { Loss::kEfficient95InPlane } -> std::convertible_to<double>;
};

/// Quadratic near zero, linear beyond k: bounded influence, but every outlier keeps some.
struct Huber {
  static constexpr double kEfficient95 =
      1.3453;  ///< 95 % as efficient as least squares on Gaussian residuals
  static constexpr double kEfficient95InPlane =
      1.5008;  ///< … when u is the length of a residual in the plane
  double k = kEfficient95;

  double rho(double squared) const {
    return squared <= k * k ? 0.5 * squared : k * std::sqrt(squared) - 0.5 * k * k;
  }
  double weight(double squared) const { return squared <= k * k ? 1.0 : k / std::sqrt(squared); }
  double curvature(double squared) const { return squared <= k * k ? 1.0 : 0.0; }
};

/// Logarithmic: influence falls off slowly.
struct Cauchy {
  static constexpr double kEfficient95 = 2.3849;
  static constexpr double kEfficient95InPlane = 2.5486;
  double k = kEfficient95;

  double rho(double squared) const { return 0.5 * k * k * std::log1p(squared / (k * k)); }
  double weight(double squared) const { return 1.0 / (1.0 + squared / (k * k)); }
  double curvature(double squared) const {
    return (1.0 - squared / (k * k)) * weight(squared) * weight(squared);
  }
};

/// Bi-weight: beyond k nothing counts. Needs a start that is nearly right.
struct Tukey {
  static constexpr double kEfficient95 = 4.6851;
  static constexpr double kEfficient95InPlane = 5.1230;
  double k = kEfficient95;

  double rho(double squared) const {
    const double inside = std::max(0.0, 1.0 - squared / (k * k));
    return k * k / 6.0 * (1.0 - inside * inside * inside);
  }
  double weight(double squared) const {
    const double inside = std::max(0.0, 1.0 - squared / (k * k));
    return inside * inside;
  }
  double curvature(double squared) const {
    const double inside = std::max(0.0, 1.0 - squared / (k * k));
    return inside * (inside - 4.0 * squared / (k * k));
  }
};

/// Gaussian: like Tukey, smooth to infinity.
struct Welsch {
  static constexpr double kEfficient95 = 2.9846;
  static constexpr double kEfficient95InPlane = 3.2510;
  double k = kEfficient95;

  double rho(double squared) const { return -0.5 * k * k * std::expm1(-squared / (k * k)); }
  double weight(double squared) const { return std::exp(-squared / (k * k)); }
  double curvature(double squared) const { return (1.0 - 2.0 * squared / (k * k)) * weight(squared); }
};

/// Rational: between Cauchy and Welsch.
struct GemanMcClure {
  static constexpr double kEfficient95 = 3.7874;
  static constexpr double kEfficient95InPlane = 4.0956;
  double k = kEfficient95;

  double rho(double squared) const { return 0.5 * k * k * squared / (k * k + squared); }
  double weight(double squared) const {
    const double ratio = k * k / (k * k + squared);
    return ratio * ratio;
  }
  double curvature(double squared) const {
    const double ratio = k * k / (k * k + squared);
    return ratio * ratio * (1.0 - 4.0 * squared / (k * k + squared));
  }
};

static_assert(RobustLoss<Huber> && RobustLoss<Cauchy> && RobustLoss<Tukey> && RobustLoss<Welsch> &&
              RobustLoss<GemanMcClure>);

/// The losses by name; `with_loss` turns a name into the type.
enum class LossKind : int { huber, cauchy, tukey, welsch, geman_mcclure };

/// What is weighted: a signed distance, or the length of a vector in the plane, which is larger by nature.
enum class Residual : int { distance, in_plane };

/// Calls `use(loss)` with the loss of a kind. `k_sigma` 0 means its 95 % constant for such residuals.
template <class Use>
decltype(auto) with_loss(LossKind kind, double k_sigma, Use&& use, Residual residual = Residual::distance) {
  const auto make = [&]<RobustLoss Loss>(Loss loss) {
    if (residual == Residual::in_plane) loss.k = Loss::kEfficient95InPlane;
    if (k_sigma > 0.0) loss.k = k_sigma;
    return loss;
  };
  switch (kind) {
    case LossKind::cauchy:
      return use(make(Cauchy{}));
    case LossKind::tukey:
      return use(make(Tukey{}));
    case LossKind::welsch:
      return use(make(Welsch{}));
    case LossKind::geman_mcclure:
      return use(make(GemanMcClure{}));
    case LossKind::huber:
      break;
  }
  return use(make(Huber{}));
}

}  // namespace beaconless
