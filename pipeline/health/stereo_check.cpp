#include <fmt/format.h>
#include <placegraph/frontend/features/detector.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/health/stereo_check.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Minimum number of matches for a result.
constexpr int kFewest = 60;

struct Pair {
  std::vector<Feature> left, right;
};

std::vector<Pair> some_pairs(const Dataset& dataset) {
  // Takes a small share of the time of a run.
  constexpr std::size_t kMostPairs = 4, kFramesAPair = 20;
  DetectorOptions detector;
  detector.max_features = 600;
  const std::size_t count = std::clamp<std::size_t>(dataset.size() / kFramesAPair, 1, kMostPairs);
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t index = (2 * k + 1) * dataset.size() / (2 * count);
    try {
      const Frame frame = dataset.frame(index, Sensor::kStereo);
      pairs.push_back(
          {detect_features(frame.image, detector), detect_features(frame.right, detector)});
    } catch (const FileError&) {
    }
  }
  return pairs;
}

bool agree(const RowOffsets& offsets) {
  return offsets.outcome && offsets.inliers > 0.5 * offsets.matches;
}

/// The rotation or shift of the right camera that would explain the row offsets.
std::string likely_cause(const RowOffsets& offsets, const Camera& camera) {
  const double half_x = 0.5 * camera.width / camera.fx, half_y = 0.5 * camera.height / camera.fy;
  const double shift = std::abs(offsets.rows[0]), roll = std::abs(offsets.rows[1]) * half_x,
               zoom = std::abs(offsets.rows[2]) * half_y;
  const double most = std::max({shift, roll, zoom});
  if (most < 0.5 * offsets.rms_px) return "as if the cameras had different lenses or directions";
  if (most == shift)
    return fmt::format("as if the right images were {:.1f} rows too {}", shift,
                       offsets.rows[0] > 0 ? "low" : "high");
  if (most == roll)
    return fmt::format("as if the right camera were rolled by {:.1f} degrees",
                       rad_to_deg(std::atan(offsets.rows[1] / camera.fx)));
  return fmt::format("as if the right images were {:.1f} % {}",
                     100 * std::abs(offsets.rows[2]) / camera.fy,
                     offsets.rows[2] > 0 ? "larger" : "smaller");
}

}  // namespace

RowOffsets check_rows(const Dataset& dataset) {
  const Camera camera = dataset.calibration(Sensor::kStereo).camera;
  const std::vector<Pair> pairs = some_pairs(dataset);
  RowOffsets offsets;
  // Two degrees of roll, or more if that finds no agreement.
  for (const double share : {0.02, 0.1}) {
    std::vector<RowSample> samples;
    for (const Pair& pair : pairs) {
      const auto of_pair =
          row_samples(camera, pair.left, pair.right, std::max(12.0, share * camera.width));
      samples.insert(samples.end(), of_pair.begin(), of_pair.end());
    }
    Random random(0, 0);
    offsets = fit_row_offsets(samples, random);
    if (agree(offsets)) break;
  }
  return offsets;
}

std::optional<DataNote> odd_rows(const RowOffsets& offsets, const Camera& camera) {
  // Three quarters of a pixel off the rows (docs/datasets.md); the bend is over the whole image.
  // Chosen by the faults of group "fixed" (tests/faults/README.md).
  constexpr double kMostRmsPx = 0.75, kMostBendPx = 1.5;
  const std::string advice =
      "; rectify the pair first, or provide both raw cameras with their distortion and poses "
      "(EuRoC's "
      "sensor.yaml): the scale is in doubt";
  if (offsets.matches < kFewest) return std::nullopt;
  if (!agree(offsets))
    return DataNote{fmt::format("matches between the cameras do not agree on rows ({} of {}): not "
                                "rectified, or not taken at the same time",
                                offsets.inliers, offsets.matches) +
                        advice,
                    true, NoteCause::kRightImage, ""};
  if (offsets.behind > 0.5 * offsets.inliers)
    return DataNote{
        fmt::format("{} of {} matches are farther right in the right images: are the cameras "
                    "swapped?",
                    offsets.behind, offsets.inliers),
        true, NoteCause::kCamerasSwapped, ""};
  const double bend_px = std::abs(offsets.rows[2]) / camera.fy * 0.5 * camera.width;
  if (offsets.rms_px < kMostRmsPx && bend_px < kMostBendPx) return std::nullopt;
  return DataNote{fmt::format("matches between the cameras are {:.1f} px off their rows (root mean "
                              "square of {}), {}",
                              offsets.rms_px, offsets.inliers, likely_cause(offsets, camera)) +
                      advice,
                  true, NoteCause::kRightImage, ""};
}

}  // namespace placegraph
