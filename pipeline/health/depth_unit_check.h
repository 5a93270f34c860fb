#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Finds depth images in another unit than assumed: depth cameras measure from two or three tenths
/// of a metre to some ten metres, and are used in the middle of that range. A wrong unit changes
/// nothing but the distances.
class DepthUnitCheck {
 public:
  void add(const Frame& frame);
  /// Reports that in most of at least three images the median distance is below 0.4 m or beyond
  /// 8 m.
  std::optional<DataNote> note() const;
  void visit_state(auto& archive) { archive(frames_, medians_m_); }

 private:
  int frames_ = 0;
  std::vector<double> medians_m_;
};

}  // namespace placegraph
