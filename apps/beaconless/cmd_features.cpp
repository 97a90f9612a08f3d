// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "commands.hpp"
#include "features_run.hpp"
#include "scan_options.hpp"

namespace beaconless::cli {
namespace {

std::string detector_names() {
  std::string names;
  for (const DetectorName& of : detectors()) names += (names.empty() ? "" : ",") + std::string(of.name);
  return names;
}

}  // namespace

void add_features(CLI::App& app, Console& console, int& exit_code) {
  auto* command =
      app.add_subcommand("features", "Find lines, corners and keypoints in the scans of a recording");
  auto words = std::make_shared<FeaturesWords>();
  command
      ->add_option("recording", words->recording,
                   "The recording: MCAP, ROS 1 or 2 bag, CARMEN log, text of rostopic or ros2 topic echo")
      ->required();
  command
      ->add_option("--detector", words->detectors,
                   "What to look for, separated by commas: " + detector_names())
      ->delimiter(',')
      ->default_str("corners,falko");
  command->add_option("--csv", words->csv,
                      "Write all keypoints: scan,detector,beam,x_m,y_m,orientation_rad,scale_m,score");
  command->add_option("--plot", words->plot, "Draw one scan with what was found in it, as SVG");
  command->add_option("--scan", words->plotted_scan,
                      "Which scan is drawn, counted from 0 (default: the first taken)");
  command
      ->add_option(
          "--sweep", words->sweep,
          "Draw into --plot instead how segments depend on their thresholds (dissertation, figures 4.5-4.9)")
      ->check(CLI::IsMember({"threshold"}));
  command->add_option("--preset", words->preset, "Whose parameters: beaconless, authors, dissertation")
      ->check(CLI::IsMember({"beaconless", "authors", "dissertation"}))
      ->capture_default_str();
  command
      ->add_option("--set", words->set,
                   "One parameter, name=value (see beaconless params --features); may be repeated")
      ->allow_extra_args(false);
  command->add_option(
      "--reference", words->reference,
      "True poses of the base: a TUM file, or 'recorded'; tells how well keypoints are found again");
  command->add_option("--pose-topic", words->pose_topic,
                      "Which poses 'recorded' means, where there are several");
  command->add_option("--base-from-laser", words->base_from_laser,
                      "The laser on the robot, x,y,deg (default 0,0,0), for --reference");
  command->add_option("--gap", words->gap, "Scans between a keypoint and its being found again")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--within", words->within_m, "How near is found again [m]")
      ->check(not_positive, "NUMBER > 0")
      ->capture_default_str();
  command->add_option("--topic", words->scan.topic, "Which scans: a topic of a bag, a keyword of a log");
  command->add_option("--scans", words->scan.scans, "Which of them, start:stop:step counted from 0");
  add_scan_range_options(*command, words->scan);
  command->footer(
      "Example:  beaconless features drive.log --detector corners,falko --scan 40 --plot scan.svg");
  command->callback([&console, &exit_code, words] { exit_code = features_run(console, *words); });
}

}  // namespace beaconless::cli
