#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Noise model of segments and the vanishing points they belong to.
///
/// end_px and parallel_deg are estimated from the image; the values here are the start.
struct VanishingNoise {
  double end_px = 0.3;        ///< standard deviation of the ends of a segment, across it
  double parallel_deg = 0.2;  ///< deviation of the scene's edges, and of the lens, from parallel
  double tail_freedom = 4;    ///< degrees of freedom of the errors (Student t)
  void check() const;
};
void visit(OptionVisitor& field, VanishingNoise& noise);

/// Vanishing points of an image, their number unknown (minimum description length).
struct VanishingPointOptions {
  VanishingNoise noise;  ///< noise of the segments
  int samples = 1000;    ///< initial hypotheses of two segments; later searches use half as many
  int max_points = 10;   ///< maximum number of vanishing points
  int min_segments = 4;  ///< minimum number of segments of a vanishing point
  void check() const;
};
void visit(OptionVisitor& field, VanishingPointOptions& options);

/// Manhattan frames: three orthogonal directions that many edges share.
struct ManhattanOptions {
  /// Deviation of the axes of a Manhattan frame from right angles, lens and calibration included.
  /// The deviation is estimated, up to twice this.
  double orthogonality_deg = 1;
  int min_segments = 4;     ///< minimum number of segments of an observed axis
  double min_evidence = 8;  ///< minimum evidence of each of the two best axes [nats]
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, ManhattanOptions& options);

/// Vanishing points and Manhattan frames of one image together.
struct SceneDirectionOptions {
  VanishingPointOptions points;  ///< the vanishing points
  ManhattanOptions manhattan;    ///< the Manhattan frames
  void check() const;
};
void visit(OptionVisitor& field, SceneDirectionOptions& options);

}  // namespace placegraph
