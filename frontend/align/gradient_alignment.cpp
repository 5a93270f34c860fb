#include <placegraph/frontend/align/gradient_alignment.h>
#include <placegraph/frontend/flow/grey_pyramid.h>

#include <Eigen/Dense>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Row = Eigen::Matrix<double, 9, 1>;
/// Columns: nine numbers of the generators, one photometric column, ones, the residual.
using Gram = Eigen::Matrix<double, 12, 12>;

/// sum w [r; a; 1; e] [r; a; 1; e]^T over the samples in view.
Gram accumulate(const TemplateLevel& level, const SeenSamples& seen, const PhotometricFit& fit,
                Similarity similarity, Gradients gradients) {
  const bool ref_column = similarity == Similarity::kSsdGainBias;
  Gram sum = Gram::Zero();
  for (std::size_t i = 0; i < seen.index.size(); ++i) {
    const double weight = fit.weight[i];
    if (!(weight > 0)) continue;
    const TemplateSample& sample = level.samples[seen.index[i]];
    Vector2d gradient = Vector2d::Zero();
    if (gradients != Gradients::kForward) gradient = fit.slope[i] * sample.gradient;
    if (gradients == Gradients::kForward) gradient = seen.gradient[i];
    if (gradients == Gradients::kEsm) gradient = 0.5 * (gradient + seen.gradient[i]);
    Eigen::Matrix<double, 12, 1> row;
    row << generator_row(sample.x, gradient), ref_column ? seen.ref[i] : seen.cur[i], 1,
        fit.residual[i];
    sum.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
  }
  sum.triangularView<Eigen::StrictlyUpper>() = sum.transpose();
  return sum;
}

/// Step of the parameters; empty if the template has too little texture to determine it.
PlanarWarp::Step solve(const Gram& gram, const PlanarWarp::Generators& A, Similarity similarity) {
  Eigen::MatrixXd H = A.transpose() * gram.topLeftCorner<9, 9>() * A;
  Eigen::VectorXd b = A.transpose() * gram.block<9, 1>(0, 11);
  if (similarity != Similarity::kSsd) {
    // Gain and bias are free parameters: they are projected out.
    const Eigen::Matrix2d D = gram.block<2, 2>(9, 9);
    const Eigen::MatrixXd C = gram.block<2, 9>(9, 0) * A;
    const double determinant = D.determinant();
    if (!(determinant > 1e-9 * D(0, 0) * D(1, 1))) return {};
    const Eigen::Matrix2d D_inverse = D.inverse();
    H -= C.transpose() * D_inverse * C;
    b -= C.transpose() * (D_inverse * gram.block<2, 1>(9, 11));
  }
  const Eigen::VectorXd diagonal = H.diagonal();
  if (!(diagonal.minCoeff() > 0)) return {};
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd S = scale.asDiagonal() * H * scale.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> llt(S);
  if (llt.info() != Eigen::Success || llt.rcond() < 1e-9) return {};
  PlanarWarp::Step x = -(scale.asDiagonal() * llt.solve(scale.asDiagonal() * b));
  if (!x.allFinite()) return {};
  return x;
}

double size_of(const PlanarTemplate& planar_template) {
  return (planar_template.corners_px()[2] - planar_template.corners_px()[0]).norm();
}

/// Shortens a step from `warp` so that no corner of the template moves by more than a quarter of
/// the template's diagonal. False if the corners do not move by a finite length.
bool limit_step(const PlanarTemplate& planar_template, const PlanarWarp& warp,
                PlanarWarp::Step& x) {
  const double largest_px = 0.25 * size_of(planar_template);
  const double moved_px =
      (planar_template.corner_jacobian(warp) * x).reshaped(2, 4).colwise().norm().maxCoeff();
  if (!std::isfinite(moved_px)) return false;
  if (moved_px > largest_px) x *= largest_px / moved_px;
  return true;
}

}  // namespace

Row generator_row(const Vector2d& x, const Vector2d& g) {
  const double along = -(g.x() * x.x() + g.y() * x.y());
  Row row;
  row << g.x() * x.x(), g.x() * x.y(), g.x(), g.y() * x.x(), g.y() * x.y(), g.y(), along * x.x(),
      along * x.y(), along;
  return row;
}

PlanarWarp::Generators template_generators(const PlanarTemplate& planar_template,
                                           const PlanarWarp& warp) {
  const Matrix3d N = planar_template.px_from_template(), N_inverse = N.inverse();
  PlanarWarp::Generators A = warp.generators();
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    Eigen::Map<RowMajor> block(A.col(k).data());
    block = (N_inverse * block * N).eval();
  }
  return A;
}

void see_samples(const TemplateLevel& samples, const PlanarTemplate& planar_template,
                 const Image& image, int level, const Matrix3d& H_cur_ref, bool with_gradients,
                 SeenSamples& seen) {
  const double scale = std::ldexp(1.0, -level);
  const Matrix3d P =
      Vector3d(scale, scale, 1).asDiagonal() * H_cur_ref * planar_template.px_from_template();
  seen.index.clear(), seen.ref.clear(), seen.cur.clear(), seen.gradient.clear();
  for (std::size_t i = 0; i < samples.samples.size(); ++i) {
    const TemplateSample& sample = samples.samples[i];
    const Vector3d q = P * sample.x.homogeneous();
    if (!(q.z() > 1e-9)) continue;
    const double u = q.x() / q.z(), v = q.y() / q.z();
    if (!inside_bicubic(image, u, v)) continue;
    seen.index.push_back(i);
    seen.ref.push_back(sample.grey);
    if (!with_gradients) {
      seen.cur.push_back(value_bicubic(image, u, v));
      continue;
    }
    const GreySample grey = sample_bicubic(image, u, v);
    seen.cur.push_back(grey.value);
    const double along = grey.du * u + grey.dv * v;
    seen.gradient.emplace_back((grey.du * P(0, 0) + grey.dv * P(1, 0) - along * P(2, 0)) / q.z(),
                               (grey.du * P(0, 1) + grey.dv * P(1, 1) - along * P(2, 1)) / q.z());
  }
}

GradientAlignmentResult align_level(const PlanarTemplate& planar_template, const Image& image,
                                    int level, const PlanarWarp& start, Gradients gradients,
                                    const GradientAlignmentOptions& options) {
  using End = GradientAlignmentResult::End;
  const TemplateLevel& samples = planar_template.levels().at(static_cast<std::size_t>(level));
  GradientAlignmentResult result;
  result.warp = start;
  SeenSamples seen;
  PhotometricFit fit;
  const bool halve = options.similarity == Similarity::kMi;
  PlanarWarp before = start;
  PlanarWarp::Step x;
  double similarity_before = 0;
  for (int halvings = 0;;) {
    see_samples(samples, planar_template, image, level, result.warp.H_cur_ref(),
                gradients != Gradients::kInverse, seen);
    const auto all = static_cast<double>(samples.samples.size());
    result.visible_share = all > 0 ? static_cast<double>(seen.index.size()) / all : 0;
    if (!(result.visible_share >= options.min_visible_share)) {
      result.end = End::kOutOfView;
      return result;
    }
    fit_photometry(options.similarity, seen.ref, seen.cur, options.kernel, options.kernel_width,
                   fit);
    if (halve && x.size() > 0 && fit.similarity < similarity_before && halvings < 6) {
      ++halvings;
      x *= 0.5;
      result.warp = before.plus(x);
      continue;
    }
    if (halvings == 6) result.warp = before;
    if (x.size() > 0) {
      result.last_step_px =
          planar_template.corner_distance_px(before.H_cur_ref(), result.warp.H_cur_ref());
      if (result.last_step_px < options.converged_px) {
        result.end = End::kConverged;
        return result;
      }
    }
    if (result.iterations >= options.iterations) return result;
    x = solve(accumulate(samples, seen, fit, options.similarity, gradients),
              template_generators(planar_template, result.warp), options.similarity);
    if (x.size() == 0 || !limit_step(planar_template, result.warp, x)) {
      result.end = End::kSingular;
      return result;
    }
    before = result.warp;
    similarity_before = fit.similarity;
    halvings = 0;
    result.warp = before.plus(x);
    ++result.iterations;
  }
}

}  // namespace placegraph
