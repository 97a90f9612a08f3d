// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace beaconless {

/// For every cell of a width x height grid, the seed nearest to it (its position in `seeds`); -1 where there
/// is no seed within `reach_cells`.
///
/// In: `seeds` are row-major cell numbers. Ties go to either. Cost: linear in the cells, two passes.
/// Source: Felzenszwalb and Huttenlocher, "Distance Transforms of Sampled Functions", Theory of Computing
/// 2012; exact.
std::vector<std::int32_t> nearest_seeds(int width_cells, int height_cells,
                                        std::span<const std::int32_t> seeds, double reach_cells);

}  // namespace beaconless
