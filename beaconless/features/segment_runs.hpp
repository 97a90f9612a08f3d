// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "beaconless/features/scan_segment.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless {

/// The runs of hits between breaks: how every segmentation ends.
///
/// In: one byte a beam, not 0 where a segment ends with that beam; a beam that is no hit must have one, and
/// so must the beam before it, and the last beam of a scan that is no full circle. Out: the runs of at least
/// `min_beams` in order of their first beams; of a full circle without breaks one that begins at the farthest
/// beam.
void segments_from_breaks(const Scan& scan, std::span<const std::uint8_t> breaks, std::size_t min_beams,
                          std::vector<ScanSegment>& segments);

}  // namespace beaconless
