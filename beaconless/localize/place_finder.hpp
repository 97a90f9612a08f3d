// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "beaconless/core/describe.hpp"
#include "beaconless/core/stamp.hpp"
#include "beaconless/map/nearness_pyramid.hpp"
#include "beaconless/map/surface_map.hpp"
#include "beaconless/match/global_search.hpp"
#include "beaconless/match/icp.hpp"
#include "beaconless/match/scan_evidence.hpp"
#include "beaconless/match/walls.hpp"

namespace beaconless {

/// When a place is taken for the robot's.
struct PlacesConfig {
  GlobalSearchConfig search;
  double sigma_m = 0.05;  ///< by how much surfaces of the map may be off; no less than a grid's cells
  double margin = 0.05;   ///< log-likelihood of a beam, added up over views, that a place must be ahead …
  double doubt = 1.0;     ///< … and more by so many times the share of the scan that is not on the map
  double least_explained = 0.5;    ///< share of the scan that must lie on the map there
  double least_likelihood = -1.0;  ///< mean log-likelihood of a beam that a place must reach
  double view_m = 0.4;             ///< a new view begins when the laser has moved so far …
  double view_deg = 20.0;          ///< … or turned so far
  double every_s = 0.5;            ///< how often is looked again where nothing was found
};

void describe(Fields& fields, PlacesConfig& config);

/// Finds a laser that may be anywhere on the map, or in a part of it: looks for all places that fit, follows
/// them from scan to scan, and tells when one explains what was seen so much better than all others that it
/// must be it.
///
/// What was seen is a list of views, scans from places apart: scans from one place tell little more than the
/// first of them. With every view the whole region is searched again, and a place that comes up late is
/// judged by all views so far: it is followed back along the way. Poses are map_from_laser. Source: for the
/// search see search_everywhere(); multiple hypotheses after Jensfelt and Kristensen, IEEE T-RA 2001.
class PlaceFinder {
 public:
  enum class Verdict {
    nothing,  ///< the scan fits nowhere
    several,  ///< more than one place fits, or the one that fits is not held in all directions
    one,
  };

  /// A place where the laser may be.
  struct Place {
    Pose2 map_from_laser;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
    int rank = 0;
    ScanEvidence now;                     ///< of the last scan
    std::vector<double> log_likelihoods;  ///< mean of a beam, of every view
    double total = 0.0;                   ///< their sum
    int scans_in_view = 0;
  };

  PlaceFinder(const PlacesConfig& config, std::shared_ptr<const SurfaceMap> map, const IcpConfig& icp,
              const WallsConfig& walls);

  /// Whether a place, map_from_laser, is one where the laser may have been at the beginning.
  using Wanted = std::function<bool(const Pose2&)>;

  /// Forgets all; the laser is in this box, at a place that is wanted; all are, if that is empty. Both are of
  /// the first scan: wherever the laser went from there it is looked for.
  void begin(const FloorPlan::Bounds& box, Wanted wanted = {});
  void begin();  ///< anywhere on the map
  /// On the part of the map that is no further off in x and y than this, from the nearest point of the map.
  void begin_around(const Eigen::Vector2d& middle, double reach_m);
  void begin_again();  ///< where it was before

  /// A place to look at with the next view, whether the search finds it or not: where all looks alike it
  /// keeps some places of many.
  void propose(const Pose2& map_from_laser) { proposed_ = map_from_laser; }

  /// Takes in a scan. In: its points in the laser frame at the stamp; how the laser has moved since the last
  /// scan (last_from_now) where that is known. Cost: a search of the region (tens of ms) with each view, a
  /// fit a place with any other scan.
  Verdict see(Stamp stamp, std::span<const Eigen::Vector2d> points, const std::optional<Pose2>& moved);

  /// How the laser moved between the last two scans (before_from_now), as the likeliest place tells it.
  /// Nothing where that place no longer fits.
  std::optional<Pose2> moved() const;

  /// What is left, likeliest first; after Verdict::nothing the best that there is, or none.
  std::span<const Place> places() const { return places_; }
  /// Those of them that are not ruled out by the best, itself among them.
  std::span<const Place> likely() const;
  /// Whether all others are so far behind the best that nobody need reckon with them.
  bool is_alone() const;
  /// How likely each is, if it is one of the likely ones; those add up to 1.
  double weight(const Place& place) const;

 private:
  struct View {
    std::vector<Eigen::Vector2d> points;
    Pose2 to_next;  ///< its laser frame from that of the next view
  };

  bool is_new_view() const;
  void look();
  void follow(const Pose2& moved);
  bool add(const StartPose& start, bool is_promising);
  void step_aside(Place& place) const;
  Pose2 weigh_past(Place& place) const;
  void begin_anew();
  FloorPlan::Bounds reachable() const;
  bool fit(std::span<const Eigen::Vector2d> points, const Pose2& guess, Place& place) const;
  void sort_out();
  Verdict verdict() const;
  double needed_margin() const;

  PlacesConfig config_;
  std::shared_ptr<const SurfaceMap> map_;
  IcpConfig icp_;
  WallsConfig walls_;
  NearnessPyramid nearness_;
  FloorPlan::Bounds map_box_;
  FloorPlan::Bounds box_;
  Wanted wanted_;
  std::span<const Eigen::Vector2d> points_;
  std::vector<Place> places_;
  std::vector<View> views_;
  Pose2 begin_from_first_;  // laser frame of the first view from that of the beginning
  double gone_m_ = 0.0;     // since the beginning, view by view
  Pose2 since_view_;        // view's laser frame from the laser's now
  std::optional<Pose2> moved_;
  std::optional<Pose2> proposed_;
  std::optional<Stamp> looked_;
  bool is_hopeless_ = true;  // nothing fitted the scan before
  mutable GlobalSearchScratch search_scratch_;
  mutable IcpScratch icp_scratch_;
  mutable WallsScratch walls_scratch_;
  std::vector<StartPose> starts_;
};

}  // namespace beaconless
