// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/report/html.hpp"
#include "beaconless/report/run_report.hpp"

/// The tables of a run's page; without rows where there is nothing to tell.
namespace beaconless::report {

/// The dissertation's figures of the errors, as they are and aligned.
Table error_table(const RunReport& report);

/// The places that fitted while it was not clear where the robot is.
Table places_table(const RunReport& report);

}  // namespace beaconless::report
