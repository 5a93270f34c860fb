#pragma once
#include <placegraph/frontend/internal/segments/segment_detector.h>
#include <placegraph/frontend/internal/segments/segment_flow.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace placegraph {

/// A straight edge followed over time. Its line, with the covariance of its support in the newest
/// frame, is measured anew in every frame and does not drift; its ends are those of its support.
struct LineTrack {
  LineId id;
  EdgeSegment edge;      ///< in the newest image, brighter side on the right
  LineSegment previous;  ///< in the image before
  int age = 0;           ///< frames since detection
};

/// Follows straight edges over frames. Each is aligned across its direction from where it is
/// expected, measured on the gradient, held to the same polarity and the same surroundings, and
/// followed back as a check. Pieces that turn out to lie on one edge become one track, the older
/// one's. Ids are never used twice.
class LineTracker {
 public:
  explicit LineTracker(const LineTrackerOptions& options);

  /// Follows all tracks into `image` (CV_8UC1, the size of the last); lost ones are dropped.
  /// `expected` holds a segment for each present track, its ends those of the track where they are
  /// now thought to be, or is empty (nothing moved); one without length means that the track cannot
  /// be seen.
  void track(const Image& image, const std::vector<LineSegment>& expected = {});
  /// Where a segment of the last image is thought to be some frames later, its ends anywhere.
  using WhereLater = std::function<LineSegment(const LineSegment&)>;
  /// Detects edges of the last image that no track covers, where tracks are few; `mask` 0 = not
  /// here (may be empty). The longest come first, but those that will have left the image `later`
  /// only where there are few without them.
  void detect(const Image& mask = {}, const WhereLater& later = {});
  /// Drops the tracks whose flag is false (one flag a track, in order).
  void keep(const std::vector<bool>& flags);
  /// Forgets tracks and images; ids go on counting.
  void reset();

  const std::vector<LineTrack>& tracks() const { return tracks_; }
  /// Tracks that `track` or `detect` found last to be part of another: (its id, the id it is now).
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
  std::shared_ptr<const LineProfileImage> strips_;  // of image_
  std::shared_ptr<const EdgeRefiner> refiner_;      // of image_
  LineId next_id_;
};

}  // namespace placegraph
