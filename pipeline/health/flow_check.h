#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A pixel of an image and the same point in a later one.
struct PixelDisplacement {
  Eigen::Vector2d px_ref, px_cur;
};

/// Distance of px_cur [px] to the nearest pixel at which the motion allows the point of px_ref, at
/// any positive depth: half an epipolar line, from the pixel of an infinitely distant point towards
/// the epipole. Nothing if that pixel is behind the camera.
std::optional<double> distance_to_half_line(const Camera& camera, const SE3& T_ref_cur,
                                            const PixelDisplacement& displacement);

/// Compares the estimated motion with that of the images.
///
/// Corners that cover the image evenly are tracked over two frames, apart from the points of the
/// map. An object that fills a part of the image and has most of its texture can take the points
/// of the map along; the motion then contradicts the corners on everything else.
class FlowCheck {
 public:
  explicit FlowCheck(const Calibration& calibration);

  /// Adds a frame with its pose; tracks corners in some.
  void add(const Frame& frame, const std::optional<SE3>& T_map_cam);
  /// Adds the share of the corners that contradict the motion up to a frame.
  void add(FrameId frame, double contradicting) { pairs_.push_back({frame, contradicting}); }
  /// Reports spans of frames in which a large share contradicts.
  std::optional<DataNote> note() const;
  void visit_state(auto& archive) { archive(frames_since_pair_, pairs_); }

 private:
  struct Pair {
    FrameId frame;
    double contradicting;
    void visit_state(auto& archive) { archive(frame, contradicting); }
  };
  std::optional<double> share_contradicting(const Frame& frame, const SE3& T_map_cam) const;

  Camera camera_;
  Frame before_;  // the frame two before the next pair, if that is due
  std::optional<SE3> T_map_before_;
  int frames_since_pair_ = 0;
  std::vector<Pair> pairs_;
};

}  // namespace placegraph
