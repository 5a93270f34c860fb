#pragma once
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/trajectory/result.h>

#include <string>
#include <vector>

namespace placegraph {

/// Panels of an evaluation below each other in the area of a figure, whose size they set. The
/// results have outcomes; the first curve of a legend is the ground truth, where it is drawn.
void draw_coordinates(const std::vector<EvaluationResult>& results, Figure& figure);
void draw_angles(const std::vector<EvaluationResult>& results, Figure& figure);
void draw_relative_errors(const std::vector<EvaluationResult>& results, Figure& figure);
void draw_lengths(const std::vector<EvaluationResult>& results, Figure& figure);

/// The name of an estimate in a legend: that of its file without the ending of a trajectory.
std::string plot_name(const std::string& name);

}  // namespace placegraph
