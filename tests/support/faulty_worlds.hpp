// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "beaconless/core/rng.hpp"
#include "beaconless/map/floor_plan.hpp"

namespace beaconless::test {

/// What is different from the map, or from what the laser is said to be.
enum class Fault {
  none,
  people,      ///< bursts that cover 20 to 60 % of the beams, from 2 cm to 2.5 m before what is behind
  row,         ///< something flat stands before one wall, 2 to 30 cm, along much of it
  moved,       ///< one piece of furniture stands 2 to 50 cm away and is turned
  rearranged,  ///< a third of the furniture does
  wall,        ///< one wall is drawn wrong by 1 to 5 cm
  walls,       ///< each wall may be, one in three
  unmapped,    ///< a third of the furniture is on no map
  glass,       ///< two walls send nothing back
  noise,       ///< ranges scatter by 5 to 20 mm instead of 10
  everything,  ///< people, one thing moved, one wall wrong, one without return, another noise
};

inline constexpr std::array kFaults{Fault::none,       Fault::people, Fault::row,       Fault::moved,
                                    Fault::rearranged, Fault::wall,   Fault::walls,     Fault::unmapped,
                                    Fault::glass,      Fault::noise,  Fault::everything};

constexpr std::string_view to_string(Fault fault) {
  constexpr std::array<std::string_view, kFaults.size()> kNames{
      "none",  "people",   "row",   "moved", "rearranged", "wall",
      "walls", "unmapped", "glass", "noise", "everything"};
  return kNames[static_cast<std::size_t>(fault)];
}

enum class Place { cluttered_room, plain_room, hall, corridor, racks };

inline constexpr std::array kPlaces{Place::cluttered_room, Place::plain_room, Place::hall, Place::corridor,
                                    Place::racks};

constexpr std::string_view to_string(Place place) {
  constexpr std::array<std::string_view, kPlaces.size()> kNames{"cluttered room", "plain room", "hall",
                                                                "corridor", "racks"};
  return kNames[static_cast<std::size_t>(place)];
}

/// A place with walls along the axes, of which each may be off, and furniture.
struct FaultyWorld {
  struct Box {
    Pose2 at;
    Eigen::Vector2d size;
  };

  FaultyWorld(Place place, Rng& rng) {
    const auto between = [&](double low, double high) { return rng.uniform(low, high); };
    const auto put = [&](int count, double least, double most) {
      for (int i = 0; i < count; ++i)
        boxes.push_back({{between(0.0, width_m), between(0.0, height_m), between(-kPi, kPi)},
                         {between(least, most), between(least, most)}});
    };
    switch (place) {
      case Place::cluttered_room:
        width_m = between(5.0, 14.0);
        height_m = between(4.0, 10.0);
        put(static_cast<int>(between(6.0, 20.0)), 0.2, 1.2);
        break;
      case Place::plain_room:
        width_m = between(3.0, 12.0);
        height_m = between(3.0, 8.0);
        put(static_cast<int>(between(0.0, 3.0)), 0.2, 0.8);
        break;
      case Place::hall:
        width_m = between(18.0, 28.0);
        height_m = between(12.0, 22.0);
        put(static_cast<int>(between(3.0, 9.0)), 0.3, 2.0);
        break;
      case Place::corridor:
        width_m = between(15.0, 50.0);
        height_m = between(1.8, 3.0);
        put(static_cast<int>(between(0.0, 6.0)), 0.2, 0.5);
        for (Box& box : boxes) box.at = {box.at.x_m, box.at.y_m < 0.5 * height_m ? 0.0 : height_m, 0.0};
        break;
      case Place::racks:
        width_m = between(18.0, 28.0);
        height_m = between(12.0, 16.0);
        for (double y = 3.0; y < height_m - 2.0; y += 3.5) {
          const double gap_m = between(8.0, width_m - 7.0);
          boxes.push_back({{0.5 * (gap_m + 0.5), y, 0.0}, {gap_m - 3.5, 1.1}});
          boxes.push_back({{0.5 * (gap_m + width_m), y, 0.0}, {width_m - gap_m - 4.5, 1.1}});
        }
        break;
    }
    // A notch in one corner, so that turning the room by half a turn does not look the same.
    notch_x_m = width_m * between(0.6, 0.8);
    notch_y_m = height_m * between(0.6, 0.8);
    walls = {0.0, 0.0, width_m, notch_y_m, notch_x_m, height_m};
  }

  /// Walls as lines: x = [0], y = [1], x = [2], y = [3], x = [4], y = [5], in turn around the room.
  std::array<double, 6> walls{};
  std::vector<Box> boxes;
  double width_m = 0.0;
  double height_m = 0.0;
  double notch_x_m = 0.0;
  double notch_y_m = 0.0;

  std::vector<Eigen::Vector2d> outline() const {
    const auto& w = walls;
    return {{w[0], w[1]}, {w[2], w[1]}, {w[2], w[3]}, {w[4], w[3]}, {w[4], w[5]}, {w[0], w[5]}, {w[0], w[1]}};
  }
  FloorPlan plan() const {
    FloorPlan plan{{outline()}};
    for (const Box& box : boxes) {
      FloorPlan::Polyline corners;
      for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}})
        corners.push_back(box.at * Eigen::Vector2d(0.5 * x * box.size.x(), 0.5 * y * box.size.y()));
      plan.walls.push_back(corners);
    }
    return plan;
  }
  /// Inside the room and no nearer to anything than `margin_m`.
  bool is_free(const Eigen::Vector2d& point, double margin_m) const {
    if (point.x() < margin_m || point.y() < margin_m || point.x() > width_m - margin_m ||
        point.y() > height_m - margin_m)
      return false;
    if (point.x() > notch_x_m - margin_m && point.y() > notch_y_m - margin_m) return false;
    return std::none_of(boxes.begin(), boxes.end(), [&](const Box& box) {
      const Eigen::Vector2d in = (box.at.inverse() * point).cwiseAbs() - 0.5 * box.size;
      return in.cwiseMax(0.0).norm() < margin_m;
    });
  }
};

}  // namespace beaconless::test
