#pragma once
#include <Eigen/Core>
#include <vector>

namespace placegraph {

/// Joint distribution of two lists of grey values.
///
/// Estimated with cubic B-spline windows (Unser & Thevenaz 2000): it is smooth in every value, so
/// that mutual information has a derivative. Each list is spread over its own range from its least
/// to its greatest value.
class JointHistogram {
 public:
  /// Number of bins of each list; the outer two on either side are margin for the windows.
  static constexpr int kBins = 16;

  /// Builds the histogram. Precondition: lists of one size. Equal values fall into one bin.
  JointHistogram(const std::vector<double>& ref, const std::vector<double>& cur);

  /// Mutual information sum p(c, r) log(p(c, r) / (p(c) p(r))) [nat]; 0 for empty lists.
  double mutual_information() const;

  /// Linearizes mutual information at every sample.
  ///
  /// `mean` is the conditional mean of the current value given the template's, `slope` its slope,
  /// `residual` is -N s^2 dMI/dcur [grey levels] with s^2 the conditional variance, windows
  /// included: for a joint normal distribution the deviation from the mean, shrunk towards the
  /// overall one.
  void linearize(const std::vector<double>& ref, const std::vector<double>& cur,
                 std::vector<double>& mean, std::vector<double>& slope,
                 std::vector<double>& residual) const;

 private:
  /// Bins of a value: first ... first + 3 with these shares.
  struct Window {
    int first;
    double share[4], derivative[4];  ///< derivative with respect to the value [1 per grey level]
  };
  struct Scale {
    double low = 0, bins_per_grey = 0;
    explicit Scale(const std::vector<double>& values);
    Window window(double value) const;
    double grey(double bin) const;
  };

  Scale scale_ref_, scale_cur_;
  Eigen::MatrixXd p_;  ///< current x template
  Eigen::VectorXd p_cur_, p_ref_;
};

}  // namespace placegraph
