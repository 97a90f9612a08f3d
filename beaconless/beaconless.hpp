// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Everything a user of the library needs to localize a recording, and nothing else.
#include "beaconless/event.hpp"
#include "beaconless/io/map_io.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/io/tum.hpp"
#include "beaconless/localize/localizer.hpp"
#include "beaconless/localize/make_localizer.hpp"
#include "beaconless/pose_estimate.hpp"
