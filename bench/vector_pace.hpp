// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace beaconless::bench {

/// 200 million float operations on 8 KiB: 48 828 passes of v = 0.9999 v + 0.0001 over 2048 floats, with AVX2
/// where the machine has it.
void run_vector_loop();

/// How long that takes this thread just now, in ms: 10 to 12 on a quiet machine of 2.6 GHz. The best of five
/// goes by what the machine can, not by what else it does.
double vector_loop_ms();

}  // namespace beaconless::bench
