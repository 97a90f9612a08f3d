// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace beaconless {

/// A wall's cells in one column across it.
struct WallColumn {
  double along = 0.0;   ///< the middle of the column
  double across = 0.0;  ///< the middle of the cells in it
  int cells = 0;
};

/// The line of a wall that was drawn into cells, nearer to the axis `along` than to the other.
struct CellsLine {
  double middle = 0.0;  ///< along, of the columns that told it
  double across = 0.0;  ///< of the line, there
  double slope = 0.0;
  double slack = 0.0;  ///< that its cells stray by, beyond rounding

  double across_at(double along) const { return across + slope * (along - middle); }
};

/// The line whose cells these are, if they are those of one drawn line.
///
/// In: at least 5 columns of the same number of cells, lengths in cells. Out: nothing, where the cells stray
/// by more than rounding. Cost: the columns times the corners of what is left, which are few. Source: Dorst
/// and Smeulders, "Discrete representation of straight lines", 1984: every cell that was drawn shuts out
/// lines, and those left are a polygon of slope and offset, here cut out cell by cell; its centroid is the
/// mean of what the line can be.
std::optional<CellsLine> drawn_line(const std::vector<WallColumn>& columns);

/// The same of most of the columns, the others belonging to what stands against the wall: those near the line
/// through two of them that has most near it. Out: these are put into `near`.
std::optional<CellsLine> drawn_line_of_most(const std::vector<WallColumn>& columns,
                                            std::vector<WallColumn>& near);

}  // namespace beaconless
