// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/scan/raw_scan.hpp"
#include "beaconless/scan/scan.hpp"

namespace beaconless::io {

/// The sweep that Scan::make turns into this scan again.
///
/// Differs: bearings of a sweep that ran clockwise may come back changed in the last bit, and beams that the
/// gate refused are the same kind of nothing (+inf, -inf, NaN), not the number they were.
RawScan raw_from(const Scan& scan);

}  // namespace beaconless::io
