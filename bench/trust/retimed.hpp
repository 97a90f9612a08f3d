// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/scan/scan.hpp"

namespace beaconless::trust {

/// The same sweep as if it had begun at another moment; intensities are left out.
Scan retimed(const Scan& scan, Stamp stamp);

}  // namespace beaconless::trust
