// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "commands.hpp"
#include "localize_run.hpp"
#include "scan_options.hpp"

namespace beaconless::cli {
void add_localize(CLI::App& app, Console& console, int& exit_code) {
  auto* command = app.add_subcommand("localize", "Find the robot's pose for every scan of a recording");
  auto words = std::make_shared<LocalizeWords>();
  command
      ->add_option("recording", words->recording,
                   "The recording: MCAP, ROS 1 or 2 bag, CARMEN log, text of rostopic or ros2 topic echo")
      ->required();
  command->add_option("--map", words->map, "The map: floor plan YAML, or map_server YAML")->required();
  command->add_option("--out", words->out, "Folder for trajectory, estimates, config, report and summary");
  command->add_option("--method", words->method, "How (see beaconless methods)");
  command->add_option("--preset", words->preset,
                      "Whose parameters the feature detectors have: beaconless, authors, dissertation");
  command
      ->add_option("--line-fit", words->line_fit,
                   "How lines are fitted before they make corners: lsf, ransac, theil-sen, tls")
      ->check(CLI::IsMember({"lsf", "ransac", "theil-sen", "tls"}));
  command
      ->add_option("--loss", words->loss,
                   "Robust criterion of ICP: huber, cauchy, tukey, welsch, geman-mcclure")
      ->check(CLI::IsMember({"huber", "cauchy", "tukey", "welsch", "geman-mcclure"}));
  command->add_option("--start", words->start,
                      "Where the base is: x,y,deg, auto (anywhere), near:x,y,radius, resume:FILE");
  command->add_option("--start-from", words->start_from,
                      "Start pose from a TUM file, or 'recorded': from the recording");
  command
      ->add_option(
          "--base-from-laser", words->lasers.places,
          "The laser on the robot, x,y,deg (default: as tf_static in the recording tells, else 0,0,0); "
          "of several one each")
      ->allow_extra_args(false);
  command->add_option("--reference", words->reference, "Poses to compare with: a TUM file, or 'recorded'");
  command->add_option("--pose-topic", words->pose_topic,
                      "Which poses 'recorded' means, where there are several");
  command->add_option("--alone", words->alone,
                      "Take every scan for itself: start it METRES,DEGREES away from its --start-from pose");
  command->add_option("--windows", words->windows,
                      "Find every LENGTH:STRIDE scans by themselves, from --start auto or near");
  command->add_option("--save-pose", words->save_pose,
                      "Keep the last good pose in a file, for --start resume:FILE");
  command->add_option("--blackbox", words->black_box,
                      "Folder for the last half minute of events whenever the robot loses its way");
  command->add_option("--out-mcap", words->out_mcap,
                      "MCAP file with the scans, poses, transforms and diagnostics, for viewers");
  command
      ->add_option("--topic", words->lasers.topics,
                   "Which scans: a topic of a bag, a keyword of a log; of several lasers one topic each")
      ->allow_extra_args(false);
  command->add_option("--scans", words->scan.scans, "Which of them, start:stop:step counted from 0");
  command->add_option("--sigma", words->sigma_m, "Standard deviation of the laser's ranges [m]")
      ->check(not_positive, "NUMBER > 0");
  add_scan_time_options(*command, words->scan);
  add_scan_range_options(*command, words->scan);
  command->add_option("--config", words->config, "Parameters from a YAML file");
  command->add_option("--set", words->set, "One parameter, name=value; may be repeated")
      ->allow_extra_args(false);
  command->footer(
      "Example:  beaconless localize drive.bag --topic /scan --map hall.yaml --start 1.2,3.4,90 --out run/");
  command->callback([&console, &exit_code, words] {
    words->lasers.settle_one(words->scan.topic, words->base_from_laser);
    exit_code = localize_run(console, *words);
  });
}

}  // namespace beaconless::cli
