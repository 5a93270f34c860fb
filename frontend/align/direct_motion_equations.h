#pragma once
#include <placegraph/frontend/align/direct_motion.h>

namespace placegraph {

/// Gauss-Newton equations of align_motion.
///
/// The motion has six parameters xi, T_cur_ref exp(xi); the five of every plane (g, gain, bias) are
/// eliminated.
class DirectEquations {
 public:
  DirectEquations(const DirectReference& reference, const SE3& T_ref_cur, const MotionGuess& guess);

  void linearize(const Image& image_cur, int level);
  /// Takes a step; false if the equations are singular.
  bool step();
  double step_px() const {
    return step_px_;
  }  ///< mean displacement of the samples by the last step
  int visible() const { return visible_; }
  void report(DirectMotion& motion) const;
  bool covariance(DirectMotion& motion) const;

 private:
  using Local = Eigen::Matrix<double, 5, 1>;
  struct Row {
    Eigen::Matrix<double, 6, 1> J;
    Local J_local;
    Eigen::Vector2d px;
    double grey, residual = 0, weight = 0, psi_slope = 0;
    int sample = 0, plane = 0;
  };
  struct PlaneState {
    Eigen::Vector3d g;
    double gain = 1, bias = 0;
    Eigen::Matrix3d g_information;
  };
  /// Normal equations of one plane, prior included.
  struct Block {
    Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 5> C = Eigen::Matrix<double, 6, 5>::Zero();
    Eigen::Matrix<double, 5, 5> L = Eigen::Matrix<double, 5, 5>::Zero();
    Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
    Local c = Local::Zero();
  };
  std::vector<Block> blocks(bool by_slope) const;
  void weigh();
  void start_photometry();

  const DirectReference& reference_;
  MotionGuess guess_;
  SE3 T_cur_ref_;
  std::vector<PlaneState> planes_;
  std::vector<Row> rows_;
  std::vector<double> magnitudes_;
  double sigma_ = 0, step_px_ = 0;
  int visible_ = 0, all_ = 0, level_ = 0;
  bool photometry_known_ = false;
};

/// Zero-mean normalized correlation of a reference with a level of another image.
///
/// The mean over the planes, weighted by their samples; -1 if less than a third of the samples are
/// in view.
double correlation_at(const DirectReference& reference,
                      const std::vector<DirectReference::Sample>& samples, const Image& image_cur,
                      int level, const SE3& T_cur_ref);

}  // namespace placegraph
