// SPDX-License-Identifier: Apache-2.0
#include "beaconless/track/motion_filter.hpp"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "beaconless/geometry/pose_covariance.hpp"

namespace beaconless {
namespace {

constexpr double kNominalStep_s = 0.1;  // assumed between scans whose stamps do not tell
const ToldTwist kUnknownMotion{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};  // 1 m/s, 1 rad/s

const Eigen::Matrix3d kTiny = 1e-12 * Eigen::Matrix3d::Identity();  // so that nothing is divided by zero
constexpr double kFarOff = 25.0;                                    // squared standard deviations
constexpr double kCalming = 0.7;     // of what the motion changed by lately, from scan to scan
constexpr double kHeardNoise = 4.0;  // variances that what is heard may be off by and nothing has changed
constexpr double kCalm = 3e-4;       // of the squared change that is possible: steady motion

double square(double value) { return value * value; }

Twist2 twist_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

void describe(Fields& fields, MotionConfig& config) {
  fields("acceleration_mps2", config.acceleration_mps2, {0.0, 100.0},
         "how much the speed may change in a second");
  fields("turn_acceleration_radps2", config.turn_acceleration_radps2, {0.0, 1000.0},
         "how much the rate of turn may change in a second");
  fields("start_sigma_m", config.start_sigma_m, {0.0, 1e3}, "how well a start pose is known, to each side");
  fields("start_sigma_deg", config.start_sigma_deg, {0.0, 180.0}, "and its heading");
  fields("max_gap_s", config.max_gap_s, {0.0, 1e6},
         "after a longer silence the robot is taken to stand where it was");
}

void MotionFilter::start_at(const Pose2& map_from_base) {
  *this = MotionFilter(config_);
  last_ = map_from_base;
  const double turn_rad = radians(config_.start_sigma_deg);
  covariance_ =
      Eigen::Vector3d(square(config_.start_sigma_m), square(config_.start_sigma_m), square(turn_rad))
          .asDiagonal();
}

double MotionFilter::elapsed_s(Stamp stamp) const {
  const double elapsed_s = seconds_between(stamp_, stamp);
  if (elapsed_s > 0.0) return elapsed_s;
  return usual_step_s_ > 0.0 ? usual_step_s_ : kNominalStep_s;
}

Eigen::Vector3d MotionFilter::possible_change(double elapsed_s) const {
  const double move = square(config_.acceleration_mps2 * elapsed_s);
  return {move, move, square(config_.turn_acceleration_radps2 * elapsed_s)};
}

Eigen::Matrix3d MotionFilter::expected_change(double elapsed_s) const {
  return possible_change(elapsed_s).cwiseProduct(lately_).asDiagonal();
}

void MotionFilter::note_change(const ToldTwist& told, double elapsed_s, double noise) {
  const Eigen::Vector3d change =
      (told.per_s - motion_.per_s).cwiseAbs2() - noise * (told.covariance + motion_.covariance).diagonal();
  const Eigen::Vector3d seen = change.cwiseQuotient(possible_change(elapsed_s).cwiseMax(1e-12));
  const double move = std::max(seen.x(), seen.y());
  lately_ =
      (kCalming * lately_).cwiseMax(Eigen::Vector3d(move, move, seen.z())).cwiseMax(kCalm).cwiseMin(1.0);
}

ToldTwist MotionFilter::motion_at(Stamp stamp) const {
  if (!stamped_) return kUnknownMotion;
  const double dt = elapsed_s(stamp);
  ToldTwist motion = motion_;
  motion.covariance += expected_change(dt);
  if (dt > config_.max_gap_s) motion.per_s.setZero();
  return motion;
}

Prediction MotionFilter::predict(Stamp stamp) const {
  Prediction prediction{last_, covariance_, motion_at(stamp)};
  if (!stamped_) return prediction;
  const double dt = elapsed_s(stamp);
  prediction.map_from_base = last_ * Pose2::exp(twist_of(dt * prediction.motion.per_s));
  const Eigen::Matrix3d to_map = turn_of(last_);
  // A robot that has kept its speed so far may still change it now.
  Eigen::Matrix3d motion = motion_.covariance;
  motion += possible_change(dt).asDiagonal();
  prediction.covariance += dt * dt * to_map * motion * to_map.transpose();
  return prediction;
}

std::optional<ToldTwist> MotionFilter::told_by(Stamp stamp, const Pose2& map_from_base,
                                               const Eigen::Matrix3d& covariance) const {
  if (!stamped_) return std::nullopt;
  const double dt = elapsed_s(stamp);
  const Eigen::Matrix3d to_base = turn_of(map_from_base).transpose();
  const Eigen::Matrix3d both = to_base * (covariance_ + covariance) * to_base.transpose();
  return ToldTwist{(last_.inverse() * map_from_base).log().vector() / dt, both / (dt * dt)};
}

void MotionFilter::correct(Stamp stamp, const Pose2& map_from_base, const Eigen::Matrix3d& covariance) {
  const auto told = told_by(stamp, map_from_base, covariance);
  if (!told || elapsed_s(stamp) > config_.max_gap_s) return hold(stamp, map_from_base, covariance);
  note_change(*told, elapsed_s(stamp), 1.0);
  set(stamp, map_from_base, covariance);
  take(*told);
}

// What the poses told is the velocity in the middle of the last step.
double MotionFilter::since_told_s(double lasting_s) const { return 0.5 * (usual_step_s_ + lasting_s); }

bool MotionFilter::is_possible(const ToldTwist& told, double lasting_s) const {
  const Eigen::Vector3d off = told.per_s - motion_.per_s;
  Eigen::Matrix3d possible = motion_.covariance + told.covariance + kTiny;
  possible += possible_change(since_told_s(lasting_s)).asDiagonal();
  return off.dot(possible.ldlt().solve(off)) < kFarOff;
}

bool MotionFilter::hear(const ToldTwist& told, double lasting_s) {
  if (!is_possible(told, lasting_s)) return false;
  const double since_s = since_told_s(lasting_s);
  note_change(told, since_s, kHeardNoise);
  motion_.covariance += expected_change(since_s);
  take(told);
  return true;
}

void MotionFilter::take(const ToldTwist& told) {
  // In axes and units that make a unit sphere of the covariance so far: no variance can become negative
  // there, however far apart both are.
  const Eigen::LLT<Eigen::Matrix3d> before(motion_.covariance + kTiny);
  const Eigen::Matrix3d root = before.matrixL();
  const auto unit = root.triangularView<Eigen::Lower>();
  const Eigen::Matrix3d half = unit.solve(told.covariance);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> noise(symmetric(unit.solve(half.transpose())));
  if (before.info() != Eigen::Success || noise.info() != Eigen::Success) return;
  const Eigen::Array3d variances = noise.eigenvalues().array().max(0.0);
  const Eigen::Matrix3d axes = root * noise.eigenvectors();
  const Eigen::Vector3d off = noise.eigenvectors().transpose() * unit.solve(told.per_s - motion_.per_s);
  motion_.per_s += axes * (off.array() / (1.0 + variances)).matrix();
  const Eigen::Matrix3d left = axes * (variances / (1.0 + variances)).sqrt().matrix().asDiagonal();
  motion_.covariance = symmetric(left * left.transpose());
}

void MotionFilter::hold(Stamp stamp, const Pose2& map_from_base, const Eigen::Matrix3d& covariance) {
  lately_.setOnes();
  set(stamp, map_from_base, covariance);
}

void MotionFilter::set(Stamp stamp, const Pose2& map_from_base, const Eigen::Matrix3d& covariance) {
  const double dt = elapsed_s(stamp);
  if (stamped_ && dt <= config_.max_gap_s) {
    motion_.covariance += expected_change(dt);
    usual_step_s_ = dt;
  } else {
    motion_ = kUnknownMotion;
  }
  last_ = map_from_base;
  covariance_ = covariance;
  stamp_ = stamp;
  stamped_ = true;
}

}  // namespace beaconless
