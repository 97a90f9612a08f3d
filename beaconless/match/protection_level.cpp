// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/protection_level.hpp"

#include <cmath>

namespace beaconless {

void describe(Fields& fields, ProtectionConfig& config) {
  fields("risk", config.risk, {1e-12, 0.5}, "the share of scans whose error may exceed the protection level");
  fields("bias_m", config.bias_m, {0.0, 1.0},
         "standard deviation of what all beams of one wall are off by alike");
}

double protection_sigmas(double risk) { return std::sqrt(-2.0 * std::log(risk)); }

}  // namespace beaconless
