#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/pipeline/health/image_statistics.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

/// Counts images of one camera that show little of the world: blank, overexposed, covered, blurred,
/// noisy, or of another brightness than the one before.
class ImageQuality {
 public:
  /// `images`: what the note calls them, such as "images" or "right images".
  ImageQuality(const char* images, NoteCause cause) : images_(images), cause_(cause) {}

  void add(FrameId frame, const ImageStatistics& statistics);
  /// Reports the defects that more than two images and more than three per cent of them have.
  std::optional<DataNote> note() const;
  void visit_state(auto& archive) { archive(frames_, last_mean_, counts_, uniform_); }

 private:
  enum Defect { kBlank, kOverexposed, kCovered, kBlurred, kNoisy, kFlickering, kDefects };
  struct Count {
    int images = 0;
    FrameId first;
    void visit_state(auto& archive) { archive(images, first); }
  };
  void count(Defect defect, FrameId frame);
  Count covered() const;
  bool frequent(const Count& count) const;

  const char* images_;
  NoteCause cause_;
  int frames_ = 0;
  std::optional<double> last_mean_;
  std::array<Count, kDefects> counts_;
  std::vector<std::pair<FrameId, double>> uniform_;  // largest share of a grey level
};

}  // namespace placegraph
