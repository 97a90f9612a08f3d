// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "beaconless/core/result.hpp"
#include "beaconless/io/recording.hpp"
#include "beaconless/pose_estimate.hpp"

namespace beaconless::io {

/// The first line of a file of estimates; metres, radians, the upper triangle of the covariance, the status's
/// word, and 1 where the pose jumped.
inline constexpr std::string_view kEstimatesCsvHeader =
    "t,x_m,y_m,theta_rad,cov_xx_m2,cov_xy_m2,cov_xtheta_mrad,cov_yy_m2,cov_ytheta_mrad,cov_thetatheta_rad2,"
    "status,quality,protection_m,protection_rad,jumped";

/// That of files from before there were protection levels.
inline constexpr std::string_view kOldEstimatesCsvHeader =
    kEstimatesCsvHeader.substr(0, kEstimatesCsvHeader.find(",protection_m"));

/// Writes estimates as rows of comma separated values, as they come. Every number reads back as the same
/// bits.
class EstimatesCsvWriter {
 public:
  /// Opens the file and writes the header; a path that cannot be written shows in `good()`.
  explicit EstimatesCsvWriter(const std::string& path);

  void write(const PoseEstimate& estimate);
  bool good() const { return out_.good(); }

  /// Closes the file and says whether every row has reached it.
  Result<Done> finish();

 private:
  std::string path_;
  std::ofstream out_;
};

/// Reads what EstimatesCsvWriter wrote, in the order of the file. The file holds no `reason`; it is empty
/// here.
///
/// Files without protection levels are read too; nothing then bounds the errors of their estimates. Rows that
/// are no estimate (another number of values than the header, not finite, not a status) go to `on_problem`
/// and are passed over. Errors: not readable, another header. A header without rows is no error.
Result<std::vector<PoseEstimate>> read_estimates_csv(
    const std::string& path, const std::function<void(const Problem&)>& on_problem = {});

}  // namespace beaconless::io
