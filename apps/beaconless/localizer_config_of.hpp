// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "beaconless/core/result.hpp"
#include "beaconless/localize/localizer_config.hpp"

#include "localize_run.hpp"

namespace beaconless::cli {

/// Whether the file of `--config` holds parameters at all. One that does not is wrong data; a wrong parameter
/// in it is a wrong word of the call.
Result<Done> check_config_file(const std::string& path);

/// The run's configuration: defaults, then the file, then the options, then each --set.
///
/// Errors: unknown or impossible values, and options that the method would not hear of.
Result<LocalizerConfig> localizer_config_of(const LocalizeWords& words);

}  // namespace beaconless::cli
