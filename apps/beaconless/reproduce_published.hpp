// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string_view>

/// What the dissertation printed in its chapter 4, as it stands there.
namespace beaconless::cli {

/// What a table of errors is about.
enum class Quantity : int {
  position,  ///< metres; printed without a unit in most tables, as the text tells
  heading,   ///< degrees; printed without a unit
};

/// A method's row: mean, root-mean-square, standard deviation, largest and smallest error.
struct PublishedRow {
  std::string_view label;   ///< the dissertation's words
  std::string_view method;  ///< this program's
  double mean = 0.0;
  double rmse = 0.0;
  double sd = 0.0;
  double max = 0.0;
  double min = 0.0;
};

/// One of Tables 4.3 to 4.9.
struct PublishedTable {
  std::string_view number;
  std::string_view caption;
  std::string_view scenario;  ///< of data/scenarios
  Quantity quantity = Quantity::position;
  std::span<const PublishedRow> rows;
};

namespace published {

inline constexpr std::array<PublishedRow, 8> kTable43{{
    {"ICP w/o Corners", "icp-full", 0.0214, 0.0214, 0.0006, 0.0228, 0.0198},
    {"ICP w/ Corners", "icp-rdp", 0.0239, 0.0334, 0.0233, 0.1349, 0.0015},
    {"ICP w/ Corners (LSF)", "icp-corners", 0.0056, 0.0068, 0.0038, 0.0284, 0.0024},
    {"ICP w/ Corners (LSF+FT)", "icp-corners-ft", 0.0055, 0.0061, 0.0027, 0.0215, 0.0012},
    {"OC", "icp-oc", 0.0231, 0.0277, 0.0153, 0.0714, 0.0008},
    {"FALKO", "icp-falko", 0.0128, 0.0139, 0.0052, 0.0331, 0.0009},
    {"NormalBlobDetector", "icp-flirt-blob", 0.0239, 0.0251, 0.0077, 0.0476, 0.0031},
    {"NormalEdgeDetector", "icp-flirt-edge", 0.0256, 0.0269, 0.0082, 0.0626, 0.0054},
}};

inline constexpr std::array<PublishedRow, 4> kTable44{{
    {"ICP w/o Corners", "icp-full", 0.6846, 0.6854, 0.0342, 0.7717, 0.5726},
    {"ICP w/ Corners (LSF)", "icp-corners", 0.1833, 0.2197, 0.1211, 0.8335, 0.0278},
    {"ICP w/ Corners (LSF+FT)", "icp-corners-ft", 0.1833, 0.1958, 0.0687, 0.5936, 0.0875},
    {"FALKO", "icp-falko", 0.4647, 0.5322, 0.2594, 1.2251, 0.0018},
}};

inline constexpr std::array<PublishedRow, 8> kTable45{{
    {"ICP w/o Corners", "icp-full", 0.0173, 0.0184, 0.0064, 0.0296, 0.0053},
    {"ICP w/ Corners", "icp-rdp", 0.0171, 0.0213, 0.0127, 0.1355, 0.0012},
    {"ICP w/ Corners (LSF)", "icp-corners", 0.0160, 0.0172, 0.0062, 0.0338, 0.0028},
    {"ICP w/ Corners (LSF+FT)", "icp-corners-ft", 0.0160, 0.0168, 0.0051, 0.0334, 0.0013},
    {"OC", "icp-oc", 0.0311, 0.0412, 0.0269, 0.1884, 0.0009},
    {"FALKO", "icp-falko", 0.0143, 0.0164, 0.0079, 0.0620, 0.0009},
    {"NormalBlobDetector", "icp-flirt-blob", 0.0223, 0.0245, 0.0100, 0.0574, 0.0012},
    {"NormalEdgeDetector", "icp-flirt-edge", 0.0217, 0.0239, 0.0100, 0.0581, 0.0002},
}};

inline constexpr std::array<PublishedRow, 4> kTable46{{
    {"ICP w/o Corners", "icp-full", 0.0200, 0.0200, 0.0006, 0.0215, 0.0187},
    {"ICP w/ Corners (LSF)", "icp-corners", 0.0310, 0.0312, 0.0033, 0.0410, 0.0222},
    {"ICP w/ Corners (LSF+FT)", "icp-corners-ft", 0.0301, 0.0301, 0.0015, 0.0337, 0.0259},
    {"FALKO", "icp-falko", 0.0316, 0.0320, 0.0051, 0.0455, 0.0163},
}};

inline constexpr std::array<PublishedRow, 4> kTable47{{
    {"ICP w/o Corners", "icp-full", 0.4165, 0.4174, 0.0272, 0.4651, 0.2834},
    {"ICP w/ Corners (LSF)", "icp-corners", 0.2015, 0.2059, 0.0427, 0.3215, 0.0658},
    {"ICP w/ Corners (LSF+FT)", "icp-corners-ft", 0.2032, 0.2055, 0.0307, 0.2725, 0.1336},
    {"FALKO", "icp-falko", 0.2748, 0.3032, 0.1281, 0.6181, 0.0128},
}};

inline constexpr std::array<PublishedRow, 4> kTable48{{
    {"ICP w/o Corners", "icp-full", 0.0297, 0.0297, 0.0017, 0.0345, 0.0260},
    {"ICP w/ Corners (LSF)", "icp-corners", 0.0298, 0.0299, 0.0025, 0.0392, 0.0198},
    {"ICP w/ Corners (LSF+FT)", "icp-corners-ft", 0.0291, 0.0291, 0.0017, 0.0373, 0.0221},
    {"FALKO", "icp-falko", 0.0245, 0.0252, 0.0060, 0.0434, 0.0110},
}};

inline constexpr std::array<PublishedRow, 4> kTable49{{
    {"ICP w/o Corners", "icp-full", 0.4819, 0.4822, 0.0164, 0.5265, 0.4350},
    {"ICP w/ Corners (LSF)", "icp-corners", 0.5563, 0.5577, 0.0391, 0.7483, 0.4573},
    {"ICP w/ Corners (LSF+FT)", "icp-corners-ft", 0.5512, 0.5517, 0.0246, 0.6516, 0.4983},
    {"FALKO", "icp-falko", 0.5689, 0.5811, 0.1182, 0.9577, 0.2535},
}};

}  // namespace published

inline constexpr std::array<PublishedTable, 7> kPublishedTables{{
    {"4.3", "small scenario with no movement: position", "small-static", Quantity::position,
     published::kTable43},
    {"4.4", "small scenario with no movement: heading", "small-static", Quantity::heading,
     published::kTable44},
    {"4.5", "small scenario with rotation: position", "small-rotation", Quantity::position,
     published::kTable45},
    {"4.6", "full room, position 1: position", "room-position-1", Quantity::position, published::kTable46},
    {"4.7", "full room, position 1: heading", "room-position-1", Quantity::heading, published::kTable47},
    {"4.8", "full room, position 2: position", "room-position-2", Quantity::position, published::kTable48},
    {"4.9", "full room, position 2: heading", "room-position-2", Quantity::heading, published::kTable49},
}};

/// Table 4.2: seconds a scan, in Matlab, by epsilon; printed without a unit.
struct PublishedTimes {
  std::string_view label;
  double threshold_m = 0.0;  ///< D_thd of the segmentation; 0: Douglas-Peucker alone
  std::array<double, 3> seconds{};
};

inline constexpr std::array<double, 3> kTable42Epsilons_m{0.10, 0.15, 0.20};
inline constexpr std::array<PublishedTimes, 4> kTable42{{
    {"Segmentation & Douglas-Peucker, D_thd = 0.05", 0.05, {0.0267, 0.0257, 0.0250}},
    {"Segmentation & Douglas-Peucker, D_thd = 0.10", 0.10, {0.0249, 0.0245, 0.0244}},
    {"Segmentation & Douglas-Peucker, D_thd = 0.20", 0.20, {0.0280, 0.0256, 0.0253}},
    {"Douglas-Peucker without initial segmentation", 0.0, {0.0499, 0.0474, 0.0452}},
}};

}  // namespace beaconless::cli
