#pragma once
#include <placegraph/eval/alignment/alignment_options.h>
#include <placegraph/eval/association/pairing.h>
#include <placegraph/eval/errors/ape.h>
#include <placegraph/eval/errors/error_profile.h>
#include <placegraph/eval/errors/kitti_segments.h>
#include <placegraph/eval/errors/relative_error.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Options of the comparison of an estimated trajectory with the ground truth.
struct EvaluationOptions {
  Alignment alignment = Alignment::kSe3;         ///< transformation fitted before the comparison
  AlignmentSpan align_over;                      ///< poses that it is fitted to
  Vertical vertical = Vertical::kEstimated;      ///< of the truth's world
  ErrorPart part = ErrorPart::kSpace;            ///< part of the position errors that is judged
  Association association = Association::kAuto;  ///< association of poses
  AssociationOptions time;                       ///< options of the association by time
  SegmentOptions segments;                       ///< segments of t_rel and r_rel
  RelativeErrorOptions relative;                 ///< relative errors over other steps
  std::vector<ErrorBound> below;  ///< of which the share of the drive below them is given
  bool intervals = false;  ///< confidence intervals of the figures, by the errors along the drive
  void check() const;
};
void visit(OptionVisitor& field, EvaluationOptions& options);

}  // namespace placegraph
