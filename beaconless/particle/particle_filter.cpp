// SPDX-License-Identifier: Apache-2.0
#include "beaconless/particle/particle_filter.hpp"

#include <algorithm>
#include <cmath>

#include "beaconless/particle/gaussian_motion.hpp"
#include "beaconless/particle/kld.hpp"
#include "beaconless/particle/low_variance.hpp"

namespace beaconless {
namespace {

constexpr double kOnePlace = 0.95;     // of all weight, in one cluster
constexpr double kFewEffective = 0.5;  // share of the particles below which others are drawn
constexpr int kTemperSteps = 12;       // halvings on the way to the temper that is asked for
constexpr double kHintSigma_m = 0.1;   // around a pose that was searched for
constexpr double kHintSigma_rad = 0.05;

}  // namespace

ParticleFilter::ParticleFilter(const Map& map, const SurfaceMap& surfaces, const Pose2& base_from_laser,
                               const AmclConfig& config)
    : config_(config),
      laser_(map, surfaces, base_from_laser, config),
      free_space_(map),
      rng_(static_cast<std::uint64_t>(config.seed)),
      means_(config.recovery_alpha_slow, config.recovery_alpha_fast) {
  config_.max_particles = std::max(config.max_particles, config.min_particles);
  const auto most = static_cast<std::size_t>(config_.max_particles);
  particles_.reserve(most);
  drawn_.reserve(most);
  logs_.reserve(most);
  before_.reserve(most);
  bins_.clear(most);
  finder_.reserve(most);
  clusters_ = &finder_.find(particles_);
}

void ParticleFilter::start_at(const Pose2& map_from_base, const Eigen::Matrix3d& covariance) {
  const auto count = static_cast<std::size_t>(config_.max_particles);
  particles_.clear();
  const Pose2 place{map_from_base.x_m, map_from_base.y_m, 0.0};
  for (std::size_t i = 0; i < count; ++i) particles_.add(place, 1.0 / static_cast<double>(count));
  // The covariance is along the axes of the map, as a base without a heading sees it.
  move_by_gaussian({}, covariance, rng_, particles_);
  for (double& theta : particles_.theta_rad) theta = wrap_angle(theta + map_from_base.theta_rad);
  means_.forget();
  clusters_ = &finder_.find(particles_);
  updates_ = 0;
}

void ParticleFilter::spread_over(const FreeSpace& space) {
  const auto count = static_cast<std::size_t>(config_.max_particles);
  particles_.clear();
  for (std::size_t i = 0; i < count; ++i)
    particles_.add(space.sample(rng_), 1.0 / static_cast<double>(count));
  means_.forget();
  clusters_ = &finder_.find(particles_);
  updates_ = 0;
}

void ParticleFilter::move(const Pose2& motion, const Eigen::Matrix3d& covariance) {
  move_by_gaussian(motion, covariance, rng_, particles_);
}

bool ParticleFilter::weigh(const Scan& scan, std::span<const Eigen::Vector2d> points) {
  // 1. What the scan says of each particle.
  const bool is_in_one_place = !clusters_->empty() && clusters_->front().weight > kOnePlace;
  const std::size_t beams = laser_.weigh(particles_, scan, points, is_in_one_place, logs_);
  if (beams == 0) return false;
  // 2. Weights.
  set_weights(beams);
  // 3. Where the cloud is.
  clusters_ = &finder_.find(particles_);
  ++updates_;
  return true;
}

void ParticleFilter::set_weights(std::size_t beams) {
  const auto all = static_cast<double>(beams);
  // 1. How well the cloud explains the scan, against how well it used to.
  const bool is_product = config_.laser_model_type != LaserModel::likelihood_field;
  double mean = 0.0;
  for (std::size_t i = 0; i < logs_.size(); ++i)
    mean += particles_.weight[i] * std::exp(is_product ? logs_[i] / all : logs_[i]);
  means_.add(mean);
  // 2. Weights by as many beams as are independent, or fewer where hardly a particle would be left.
  before_ = particles_.weight;
  const double temper = is_product ? std::min(1.0, config_.laser_independent_beams / all) : 1.0;
  const double least = config_.least_effective_ratio * static_cast<double>(particles_.size());
  if (weigh_tempered(temper) >= least) return;
  if (effective_count(before_) < least) return;  // it was no better before
  double low = 0.0;
  double high = temper;
  for (int i = 0; i < kTemperSteps; ++i) {
    const double middle = 0.5 * (low + high);
    (weigh_tempered(middle) >= least ? low : high) = middle;
  }
  weigh_tempered(low);
}

double ParticleFilter::weigh_tempered(double temper) {
  const double most = *std::max_element(logs_.begin(), logs_.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    particles_.weight[i] = before_[i] * std::exp(temper * (logs_[i] - most));
    sum += particles_.weight[i];
  }
  if (!(sum > 0.0)) {  // the best had no weight before; the scan alone decides then
    std::fill(before_.begin(), before_.end(), 1.0);
    return weigh_tempered(temper);
  }
  for (double& weight : particles_.weight) weight /= sum;
  return effective_count(particles_.weight);
}

std::size_t ParticleFilter::wanted_count() {
  const auto most = static_cast<std::size_t>(config_.max_particles);
  bins_.clear(particles_.size());
  comb_weights(particles_.weight, most, 0.5,
               [&](std::size_t i, std::size_t /*times*/) { bins_.add(particles_.pose(i)); });
  return std::clamp(kld_sample_count(bins_.count(), config_.kld_err, config_.kld_z),
                    static_cast<std::size_t>(config_.min_particles), most);
}

void ParticleFilter::resample(bool may_recover, std::span<const Pose2> hints) {
  // 1. Whether it is due.
  if (particles_.size() == 0 || updates_ < config_.resample_interval) return;
  const double lost = may_recover ? means_.lost_share() : 0.0;
  const double effective = effective_count(particles_.weight);
  const bool is_even = effective > kFewEffective * static_cast<double>(particles_.size());
  if (config_.selective_resampling && is_even && !(lost > 0.0)) return;
  updates_ = 0;
  // 2. How many, and how many of them anywhere.
  const std::size_t count = lost > 0.0 ? static_cast<std::size_t>(config_.max_particles) : wanted_count();
  const auto anywhere = static_cast<std::size_t>(lost * static_cast<double>(count) + rng_.uniform());
  const std::size_t kept = count - std::min(anywhere, count);
  // 3. Those that stay, by their weights.
  drawn_.clear();
  if (kept > 0) draw_low_variance(particles_, kept, rng_.uniform(), drawn_);
  // 4. Those anywhere, every second one where a search points to.
  for (std::size_t i = kept; i < count; ++i) {
    const bool is_hinted = !hints.empty() && i % 2 == 0;
    Pose2 pose = is_hinted ? hints[i / 2 % hints.size()] : free_space_.sample(rng_);
    if (is_hinted)
      pose = pose * Pose2{rng_.normal(kHintSigma_m), rng_.normal(kHintSigma_m), rng_.normal(kHintSigma_rad)};
    drawn_.add(pose, 0.0);
  }
  std::fill(drawn_.weight.begin(), drawn_.weight.end(), 1.0 / static_cast<double>(count));
  std::swap(particles_, drawn_);
}

}  // namespace beaconless
