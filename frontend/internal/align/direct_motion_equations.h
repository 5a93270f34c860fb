#pragma once
#include <placegraph/frontend/internal/align/direct_motion.h>

namespace placegraph {

/// Gauss-Newton for align_motion: the motion's six parameters xi, T_cur_ref exp(xi), with the five
/// of every plane (g, gain, bias) eliminated.
class DirectEquations {
 public:
  DirectEquations(const DirectReference& reference, const SE3& T_ref_cur, const MotionGuess& guess,
                  const DirectMotionOptions& options);

  void linearize(const Image& image_cur, int level);
  /// False where the equations leave something open.
  bool step();
  double step_px() const { return step_px_; }  ///< mean way of the samples by the last step
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
  /// Of one plane, what is known beforehand included.
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
  const DirectMotionOptions& options_;
  MotionGuess guess_;
  SE3 T_cur_ref_;
  std::vector<PlaneState> planes_;
  std::vector<Row> rows_;
  std::vector<double> magnitudes_;
  double sigma_ = 0, step_px_ = 0;
  int visible_ = 0, all_ = 0, level_ = 0;
  bool photometry_known_ = false;
};

/// Mean over the planes, by their samples, of the zero-mean normalized correlation of a reference
/// with a level of another image; -1 where less than a third of the samples are in view.
double correlation_at(const DirectReference& reference,
                      const std::vector<DirectReference::Sample>& samples, const Image& image_cur,
                      int level, const SE3& T_cur_ref);

}  // namespace placegraph
