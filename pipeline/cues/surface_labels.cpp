#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/cues/surface_labels.h>

#include <opencv2/imgproc.hpp>

namespace placegraph {

SurfaceLabeller::SurfaceLabeller(std::shared_ptr<const SceneModel> surfaces,
                                 const SceneMaskOptions& options)
    : surfaces_(std::move(surfaces)), options_(options) {
  options_.check();
  require(surfaces_ && surfaces_->kind == SceneModel::Kind::kSurfaces &&
              surfaces_->class_count() == kSurfaceCount,
          "SurfaceLabeller: a model of surfaces is required");
}

SurfaceLabels SurfaceLabeller::label(const Frame& frame, bool masks) const {
  const SceneView view = view_scene(frame.colour.empty() ? frame.image : frame.colour);
  const std::vector<float> surfaces = classify_superpixels(*surfaces_, view);
  SurfaceLabels observation;
  observation.frame = frame.id;
  observation.shares = surface_shares(surfaces, view);
  if (masks) observation.masks = mask_scene(surfaces, view, options_);
  return observation;
}

std::pair<std::vector<LineSegment>, Camera> edges_of(const Image& grey, const Camera& camera) {
  // Wider images are halved: the cost. Chosen.
  constexpr int kMostWidth = 640;
  Image image = grey;
  Camera of = camera;
  while (image.cols > kMostWidth) {
    Image half;
    cv::resize(image, half, {image.cols / 2, image.rows / 2}, 0, 0, cv::INTER_AREA);
    image = half;
    of.width = image.cols;
    of.height = image.rows;
    of.fx /= 2;
    of.fy /= 2;
    of.cx = (of.cx - 0.5) / 2;  // a pixel of the halved image is in the middle of four
    of.cy = (of.cy - 0.5) / 2;
  }
  SegmentDetectorOptions options;
  options.min_length_px = 20;
  return {segments_of(detect_segments(image, options)), of};
}

}  // namespace placegraph
