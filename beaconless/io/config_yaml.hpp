// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "beaconless/core/describe.hpp"

namespace beaconless::io {

/// Sets the fields of a config from a YAML file; fields that it does not name keep their values.
///
/// The field "icp.max_pair_distance_m" stands there as `icp: {max_pair_distance_m: 0.4}`, in block or flow
/// form, or as the one key `icp.max_pair_distance_m: 0.4`. An empty file sets nothing. Errors (path:line, the
/// key, the value met, what is allowed): an unknown key (the nearest known one is named), a field set twice,
/// a value that is not allowed, a list. After an Error every field is as it was before.
Result<Done> read_config(const std::string& path, const std::vector<Field>& fields);

/// Every field of a run as YAML that `read_config` takes, each with its allowed values and its sentence as a
/// comment; those that differ from `defaults` (the same config's fields, in the same order) are marked
/// "changed, default …".
std::string config_yaml(const std::vector<Field>& fields, const std::vector<Field>& defaults);

/// Writes that text to a file.
Result<Done> write_config(const std::string& path, const std::vector<Field>& fields,
                          const std::vector<Field>& defaults);

}  // namespace beaconless::io
