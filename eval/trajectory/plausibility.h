#pragma once
#include <placegraph/eval/association/frame_pair.h>

#include <string>
#include <vector>

namespace placegraph {

/// One warning line for every common error of convention that the data show. The figures are
/// computed from the unchanged estimate nevertheless.
///  - never turns: one of the two has a constant orientation, the other rotates;
///  - inverted: the motions of the inverted poses (T_cam_world given as T_world_cam) agree clearly
///    better with the truth;
///  - w first, w last: likewise those of quaternions read in the other order, of either;
///  - other axes: likewise the motions after a constant rotation of more than five degrees, as
///    between the axes of a camera and of the body;
///  - time-shifted: the motions agree clearly better when the estimate is shifted by up to
///    five frames.
/// "Clearly" is half the misfit. Straight motion at constant speed shows none of them.
std::vector<std::string> convention_warnings(const std::vector<FramePair>& pairs);

/// Misfit of the motions from pair i to pair i + stride, with the estimate's scale fitted: squared
/// differences of translations and of rotation vectors, each over the truth's sum of squares; 0 is
/// perfect, a motionless estimate has 1 and 1. `shift` compares truth i with estimate i + shift;
/// `inverted` takes the inverse of every estimated pose. NaN if no motion can be compared.
double motion_misfit(const std::vector<FramePair>& pairs, int stride, int shift, bool inverted);

}  // namespace placegraph
