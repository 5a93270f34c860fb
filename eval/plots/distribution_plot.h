#pragma once
#include <placegraph/eval/drawing/figure.h>

#include <string>
#include <vector>

namespace placegraph {

/// Numbers of one kind, such as the errors of an estimate; at least one.
struct Sample {
  std::string name;
  std::vector<double> values;
};

/// Boxes from the lower to the upper quartile with a line at the median; whiskers reach to the last
/// values within 1.5 times their distance (Tukey 1977), and a disc marks the largest value.
void draw_boxes(const std::vector<Sample>& samples, const std::string& label, Figure& figure);

/// Densities by a Gaussian kernel of Silverman's width (1986), within the range of the values, each
/// as high as its row; a bar from quartile to quartile, a ring at the median.
void draw_violins(const std::vector<Sample>& samples, const std::string& label, Figure& figure);

}  // namespace placegraph
