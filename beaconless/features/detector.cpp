// SPDX-License-Identifier: Apache-2.0
#include "beaconless/features/detector.hpp"

#include <array>

#include "beaconless/core/suggest.hpp"

namespace beaconless {
namespace {

constexpr std::array<DetectorName, 8> kDetectors{{
    {Detector::corners, "corners", "where straight walls meet, with covariance"},
    {Detector::falko, "falko", "corner-like points whose two sides are straight"},
    {Detector::oc, "oc", "right angles of walls along the scan's dominant direction"},
    {Detector::flirt_range, "flirt-range", "steps and dips of the ranges, over scales"},
    {Detector::flirt_blob, "flirt-blob", "where a bend of the wall begins and ends, over scales"},
    {Detector::flirt_edge, "flirt-edge", "where the wall's direction changes, over scales"},
    {Detector::flirt_curvature, "flirt-curvature", "where the contour bends, over scales in metres"},
    {Detector::rdp, "rdp", "vertices that Douglas and Peucker keep, each a beam with its noise"},
}};

/// Which of the four kinds of FLIRT, and the place of its scratch.
FlirtKind flirt_kind(Detector detector) {
  switch (detector) {
    case Detector::flirt_blob:
      return FlirtKind::normal_blob;
    case Detector::flirt_edge:
      return FlirtKind::normal_edge;
    case Detector::flirt_curvature:
      return FlirtKind::curvature;
    default:
      return FlirtKind::range;
  }
}

/// The parameters of that kind, whatever kind they say themselves.
FlirtConfig flirt_config(FlirtKind kind, const DetectorsConfig& config) {
  const FlirtConfig* const all[] = {&config.flirt_range, &config.flirt_blob, &config.flirt_edge,
                                    &config.flirt_curvature};
  FlirtConfig chosen = *all[static_cast<std::size_t>(kind)];
  chosen.kind = kind;
  return chosen;
}

}  // namespace

std::span<const DetectorName> detectors() { return kDetectors; }

std::string_view to_string(Detector detector) { return kDetectors[static_cast<std::size_t>(detector)].name; }

Result<Detector> detector_named(std::string_view name) {
  std::vector<std::string> known;
  known.reserve(kDetectors.size());
  for (const DetectorName& of : kDetectors) {
    if (of.name == name) return of.detector;
    known.emplace_back(of.name);
  }
  const std::string near = nearest_word(std::string(name), known);
  std::string all;
  for (const std::string& word : known) all += (all.empty() ? "" : ", ") + word;
  return Error{"detector \"" + std::string(name) + "\"", "there is no such detector",
               near.empty() ? "use one of " + all : "did you mean \"" + near + "\"? There are " + all};
}

void describe(Fields& fields, DetectorsConfig& config) {
  fields.section("corners", config.corners);
  fields.section("falko", config.falko);
  fields.section("oc", config.oc);
  fields.section("flirt_range", config.flirt_range, {"kind"});
  fields.section("flirt_blob", config.flirt_blob, {"kind"});
  fields.section("flirt_edge", config.flirt_edge, {"kind"});
  fields.section("flirt_curvature", config.flirt_curvature, {"kind"});
  fields.section("rdp", config.rdp);
}

Result<DetectorsConfig> detectors_preset(std::string_view name) {
  DetectorsConfig config;
  if (name == "beaconless") return config;
  if (name != "authors" && name != "dissertation")
    return Error{"preset \"" + std::string(name) + "\"", "there is no such preset",
                 "use beaconless, authors or dissertation"};
  if (name == "dissertation") {
    config.corners = corners_of_the_dissertation();
    config.rdp.segmentation = config.corners.lines.segmentation;
    config.rdp.splitting.epsilon_m = 0.15;  // 4.3: "values between 0.15 and 0.20 … give better results"
  }
  config.falko = falko_preset(name).value();
  config.oc = oc_preset("authors").value();
  config.flirt_range = flirtlib_tools(FlirtKind::range);
  config.flirt_blob = flirtlib_tools(FlirtKind::normal_blob);
  config.flirt_edge = flirtlib_tools(FlirtKind::normal_edge);
  config.flirt_curvature = flirtlib_tools(FlirtKind::curvature);
  return config;
}

void detect(const Scan& scan, Detector detector, const DetectorsConfig& config, DetectorScratch& scratch,
            std::vector<Keypoint>& keypoints) {
  switch (detector) {
    case Detector::corners:
      find_corners(scan, config.corners, scratch.corners, scratch.found_corners);
      keypoints.clear();
      for (const Corner& corner : scratch.found_corners) keypoints.push_back(keypoint_of(corner));
      return;
    case Detector::falko:
      return detect_falko(scan, config.falko, scratch.falko, keypoints);
    case Detector::oc:
      return detect_oc(scan, config.oc, scratch.oc, keypoints);
    case Detector::rdp:
      return find_vertices(scan, config.rdp, scratch.rdp, keypoints);
    default: {
      const FlirtKind kind = flirt_kind(detector);
      return detect_flirt(scan, flirt_config(kind, config), scratch.flirt[static_cast<std::size_t>(kind)],
                          keypoints);
    }
  }
}

std::vector<Keypoint> detect(const Scan& scan, Detector detector, const DetectorsConfig& config) {
  DetectorScratch scratch;
  std::vector<Keypoint> keypoints;
  detect(scan, detector, config, scratch, keypoints);
  return keypoints;
}

}  // namespace beaconless
