#include <placegraph/frontend/vanishing/vanishing_options.h>

namespace placegraph {

void VanishingNoise::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, VanishingNoise& noise) {
  field("end_px", noise.end_px, "initial standard deviation of a segment's ends across it [px]",
        {1e-3, 100});
  field("parallel_deg", noise.parallel_deg,
        "initial deviation of the scene's edges from parallel [deg]", {1e-3, 10});
  field("tail_freedom", noise.tail_freedom, "degrees of freedom of the errors (Student t)",
        {1, 1e6});
}

void VanishingPointOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, VanishingPointOptions& options) {
  field.group("noise", options.noise, "noise of the segments");
  field("samples", options.samples,
        "initial hypotheses of two segments; later searches use half as many", {1, 1e6});
  field("max_points", options.max_points, "maximum number of vanishing points", {1, 1000});
  field("min_segments", options.min_segments, "minimum number of segments of a vanishing point",
        {3, 1e6});
  field.retired({{"point_cost", 8}});
}

void visit(OptionVisitor& field, ManhattanOptions& options) {
  field("orthogonality_deg", options.orthogonality_deg,
        "deviation of the axes of a Manhattan frame from right angles [deg]", {0.01, 10});
  field("min_segments", options.min_segments, "minimum number of segments of an observed axis",
        {2, 1e6});
  field("min_evidence", options.min_evidence,
        "minimum evidence of each of the two best axes [nats]", {0, 1e6});
  field.retired({{"min_orthogonality", 1}});
}

void SceneDirectionOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SceneDirectionOptions& options) {
  field.group("points", options.points, "vanishing points");
  field.group("manhattan", options.manhattan, "Manhattan frames");
  field.retired({{"off_right_deg", 2}, {"free_share", 0.25}});
}

}  // namespace placegraph
