#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/segments/edge_refinement.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/segments/segment_flow.h>
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

/// A straight edge tracked over time.
///
/// Its line, with the covariance of its support in the newest frame, is measured again in every
/// frame and does not drift; its ends are those of its support.
struct LineTrack {
  LineId id;
  EdgeSegment edge;      ///< in the newest image, brighter side on the right
  LineSegment previous;  ///< in the previous image
  int age = 0;           ///< frames since detection
};

/// Tracks straight edges over frames.
///
/// Each edge is aligned across its direction from its predicted position, measured on the gradient,
/// checked for the same polarity and similar surroundings, and tracked back as a check. Pieces of
/// one edge become one track, the older one. Ids are unique.
class LineTracker {
 public:
  explicit LineTracker(const LineTrackerOptions& options);

  /// Tracks all edges into `image` (CV_8UC1, the size of the last); lost tracks are dropped.
  ///
  /// `expected` has a segment for each present track, with the predicted positions of the track's
  /// ends, or is empty (nothing moved); a segment without length means that the track is not
  /// visible.
  void track(const Image& image, const std::vector<LineSegment>& expected = {});
  /// Prediction of a segment of the last image some frames later; its ends may be outside the
  /// image.
  using WhereLater = std::function<LineSegment(const LineSegment&)>;
  /// Detects edges of the last image that no track covers, if there are few tracks.
  ///
  /// `mask`: no edges where it is 0 (may be empty). The longest have priority, but those predicted
  /// by `later` to leave the image are used only if there are few others.
  void detect(const Image& mask = {}, const WhereLater& later = {});
  /// Drops the tracks whose flag is false (one flag per track, in order).
  void keep(const std::vector<bool>& flags);
  /// Removes tracks and images; the numbering of ids continues.
  void reset();

  const std::vector<LineTrack>& tracks() const { return tracks_; }
  /// Tracks merged into others by the last `track` or `detect`: (old id, new id).
  const std::vector<std::pair<LineId, LineId>>& merged() const { return merged_; }
  const Image& image() const { return image_; }

 private:
  bool leads_back(const LineSegment& origin, const LineSegment& before, const LineSegment& aligned,
                  const EdgeSegment& edge, const LineProfileImage& strips) const;
  void merge_tracks();

  LineTrackerOptions options_;
  std::vector<LineTrack> tracks_;
  std::vector<std::pair<LineId, LineId>> merged_;
  Image image_;
  std::shared_ptr<const LineProfileImage> strips_;  // strips of image_
  std::shared_ptr<const EdgeRefiner> refiner_;      // refiner of image_
  LineId next_id_;
};

}  // namespace placegraph
