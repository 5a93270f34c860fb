// How far from the truth direct alignment of a planar template may start: the share of trials that
// end within a pixel (photographs: three, their homographies are known to half a pixel), against
// the offset of the corners at the start, for every optimizer and similarity, as it is and under
// another illumination, blur and 30 % occlusion.
//   bench_align_study OUT_PREFIX [TRIALS=20] [PLANAR_HOMOGRAPHY_FOLDER]
// writes OUT_PREFIX.tsv, OUT_PREFIX_optimizers.png and OUT_PREFIX_similarities.png.
#include <fmt/format.h>
#include <placegraph/frontend/align/aligner.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "tests/bench/rate_plot.h"
#include "tests/support/warped_template.h"

namespace {

using namespace placegraph;
using Eigen::Matrix3d;
using Eigen::Vector2d;

constexpr int kWidth = 240, kHeight = 200, kSide = 80, kLevels = 3, kSamples = 3000;
const std::vector<double> kOffsets = {4, 8, 12, 16, 20, 24, 28, 32, 36, 40};
const std::vector<std::string> kConditions = {"as it is", "illumination", "blur", "occlusion 30 %"};
const std::vector<Similarity> kSimilarities = {Similarity::kSsd, Similarity::kSsdGainBias,
                                               Similarity::kZncc, Similarity::kMi};
constexpr int kOptimizers = 6;

/// One template, one image that shows it, and what is known of it.
struct Trial {
  PlanarTemplate planar_template;
  Image image;
  Matrix3d H_cur_ref;
  double tolerance_px;
};

/// Condition, optimizer, similarity, offset.
using Key = std::tuple<std::size_t, int, int, double>;
struct Tally {
  int trials = 0, converged = 0, confident = 0;  ///< confident: it said ok and was not
  double cpu_s = 0;
  std::vector<double> errors_px;
  double rate() const { return trials > 0 ? static_cast<double>(converged) / trials : 0; }
};
using Study = std::map<Key, Tally>;

std::vector<Vector2d> square_at(const Vector2d& corner) {
  return {corner, corner + Vector2d(kSide, 0), corner + Vector2d(kSide, kSide),
          corner + Vector2d(0, kSide)};
}

/// Gamma, half the contrast and a slope of light across the image: no gain and bias undo it.
void change_light(Image& image) {
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      std::uint8_t& grey = image.at<std::uint8_t>(v, u);
      const double gamma = 255 * std::pow(grey / 255.0, 1.8);
      grey = test::to_grey((0.6 + 0.15 * u / image.cols) * gamma + 40 + 15.0 * v / image.rows);
    }
}

/// Something else before 30 % of the template: an upright bar of another texture.
void occlude(Image& image, const PlanarTemplate& t, const Matrix3d& H_cur_ref, Random& random) {
  const test::Texture other{random.next(), 24, 3, 50, 128};
  const double left = random.uniform(-1, 1 - 0.6);
  const Matrix3d to_template = (H_cur_ref * t.px_from_template()).inverse();
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const Vector2d x = (to_template * Eigen::Vector3d(u, v, 1)).hnormalized();
      if (x.cwiseAbs().maxCoeff() <= 1.2 && x.x() >= left && x.x() <= left + 0.6)
        image.at<std::uint8_t>(v, u) = test::to_grey(other.grey(u, v));
    }
}

Trial under(Trial trial, std::size_t condition, Random& random) {
  trial.image = trial.image.clone();
  if (condition == 1) change_light(trial.image);
  if (condition == 2) cv::GaussianBlur(trial.image, trial.image, {}, 2);
  if (condition == 3) occlude(trial.image, trial.planar_template, trial.H_cur_ref, random);
  return trial;
}

/// A square of texture, seen tilted and turned a little, with noise of two grey levels.
Trial rendered(Random& random) {
  const test::Texture texture{random.next(), 40, 4, 40, 128};
  const Vector2d corner(kWidth / 2 - kSide / 2, kHeight / 2 - kSide / 2);
  PlanarTemplate t(test::texture_image(kWidth, kHeight, texture), square_at(corner), kLevels,
                   kSamples);
  const Matrix3d H = test::random_homography(t, 6, random);
  Image image = test::disturbed(test::warped_texture(kWidth, kHeight, texture, H), 2, random);
  return {std::move(t), image, H, 1};
}

Matrix3d read_homography(const std::string& path) {
  std::ifstream file(path);
  Matrix3d H;
  for (int i = 0; i < 9; ++i) file >> H(i / 3, i % 3);
  require(!file.fail(), path + ": nine numbers expected");
  return H;
}

Image read_grey(const std::string& path) {
  Image image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  require(!image.empty(), path + ": cannot be read");
  return image;
}

/// The photographs that a folder has of its three scenes: the first of each and those that differ
/// from it moderately.
struct Photograph {
  Image ref, cur;
  Matrix3d H_cur_ref;
};

std::vector<Photograph> read_photographs(const std::string& folder) {
  std::vector<Photograph> pairs;
  for (const std::string scene : {"graf", "leuven", "boat"})
    for (const int i : {2, 3}) {
      const std::string base = folder + "/" + scene;
      pairs.push_back({read_grey(base + "/img1.png"),
                       read_grey(fmt::format("{}/img{}.png", base, i)),
                       read_homography(fmt::format("{}/H1to{}p", base, i))});
    }
  return pairs;
}

/// A square with structure, well within both photographs.
Trial photographed(const std::vector<Photograph>& pairs, int number, Random& random) {
  const Photograph& pair = pairs[static_cast<std::size_t>(number) % pairs.size()];
  for (;;) {
    const Vector2d corner(std::floor(random.uniform(40, pair.ref.cols - kSide - 40)),
                          std::floor(random.uniform(40, pair.ref.rows - kSide - 40)));
    const auto square = square_at(corner);
    bool within = true;
    for (const Vector2d& px : square) {
      const auto seen = map_pixel(pair.H_cur_ref, px);
      within = within && seen && seen->minCoeff() > 50 && seen->x() < pair.cur.cols - 50 &&
               seen->y() < pair.cur.rows - 50;
    }
    if (!within) continue;
    const cv::Rect box(static_cast<int>(corner.x()), static_cast<int>(corner.y()), kSide, kSide);
    cv::Scalar mean, deviation;
    cv::meanStdDev(pair.ref(box), mean, deviation);
    if (deviation[0] < 20) continue;
    return {PlanarTemplate(pair.ref, square, kLevels, kSamples), pair.cur, pair.H_cur_ref, 3};
  }
}

void run_trial(const Trial& trial, std::size_t condition, const Matrix3d& start, double offset,
               Study& study) {
  for (int optimizer = 0; optimizer < kOptimizers; ++optimizer)
    for (const Similarity similarity : kSimilarities) {
      AlignOptions options;
      options.optimizer = static_cast<AlignOptimizer>(optimizer);
      options.gradient.similarity = similarity;
      const std::clock_t begin = std::clock();
      const AlignResult result = align(trial.planar_template, trial.image,
                                       trial.planar_template.homography(start), options);
      Tally& tally = study[{condition, optimizer, static_cast<int>(similarity), offset}];
      tally.cpu_s += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
      const double error_px =
          trial.planar_template.corner_distance_px(result.warp.H_cur_ref(), trial.H_cur_ref);
      ++tally.trials;
      tally.errors_px.push_back(error_px);
      if (error_px < trial.tolerance_px)
        ++tally.converged;
      else
        tally.confident += result.outcome ? 1 : 0;
    }
}

std::string table(const Study& study) {
  std::string text =
      "condition\toptimizer\tsimilarity\toffset_px\ttrials\tconverged\tmedian_error_px\t"
      "wrong_but_ok\tcpu_ms\n";
  for (const auto& [key, tally] : study) {
    const auto& [condition, optimizer, similarity, offset] = key;
    std::vector<double> errors = tally.errors_px;
    std::sort(errors.begin(), errors.end());
    text += fmt::format(
        "{}\t{}\t{}\t{:g}\t{}\t{:.3f}\t{:.3f}\t{}\t{:.2f}\n", kConditions[condition],
        align_optimizer_names()[static_cast<std::size_t>(optimizer)],
        similarity_names()[static_cast<std::size_t>(similarity)], offset, tally.trials,
        tally.rate(), errors[errors.size() / 2], tally.confident, 1e3 * tally.cpu_s / tally.trials);
  }
  return text;
}

placegraph::bench::RateCurve curve_of(const Study& study, std::size_t condition, int optimizer,
                                      Similarity similarity, const std::string& name) {
  bench::RateCurve curve{name, {}, {}};
  for (const double offset : kOffsets) {
    const auto found = study.find({condition, optimizer, static_cast<int>(similarity), offset});
    if (found == study.end()) continue;
    curve.at.push_back(offset);
    curve.rate.push_back(found->second.rate());
  }
  return curve;
}

void draw(const std::string& prefix, const Study& study) {
  std::vector<bench::RatePanel> optimizers, similarities;
  for (std::size_t condition = 0; condition < kConditions.size(); ++condition) {
    bench::RatePanel panel{kConditions[condition] + ", ZNCC", {}};
    for (int i = 0; i < kOptimizers; ++i)
      panel.curves.push_back(curve_of(study, condition, i, Similarity::kZncc,
                                      align_optimizer_names()[static_cast<std::size_t>(i)]));
    optimizers.push_back(panel);
  }
  for (const AlignOptimizer optimizer : {AlignOptimizer::kEsm, AlignOptimizer::kSwarmEsm})
    for (std::size_t condition = 0; condition < kConditions.size(); ++condition) {
      const auto index = static_cast<std::size_t>(optimizer);
      bench::RatePanel panel{kConditions[condition] + ", " + align_optimizer_names()[index], {}};
      for (const Similarity similarity : kSimilarities)
        panel.curves.push_back(curve_of(study, condition, static_cast<int>(optimizer), similarity,
                                        similarity_names()[static_cast<std::size_t>(similarity)]));
      similarities.push_back(panel);
    }
  const std::string label = "offset of the corners at the start [px]";
  bench::write_rate_plot(prefix + "_optimizers.png", "Trials that converged, by optimizer", label,
                         optimizers, 4);
  bench::write_rate_plot(prefix + "_similarities.png", "Trials that converged, by similarity",
                         label, similarities, 4);
}

void run(int argc, char** argv) {
  require(argc >= 2 && argc <= 4, "bench_align_study OUT_PREFIX [TRIALS] [FOLDER]");
  const int trials = argc > 2 ? std::atoi(argv[2]) : 20;
  require(trials > 0, "TRIALS must be positive");
  const auto photographs = argc > 3 ? read_photographs(argv[3]) : std::vector<Photograph>();
  Study study;
  for (int i = 0; i < trials; ++i) {
    Random random(4000, static_cast<std::uint64_t>(i));
    const Trial plain =
        photographs.empty() ? rendered(random) : photographed(photographs, i, random);
    for (std::size_t condition = 0; condition < kConditions.size(); ++condition) {
      const Trial trial = under(plain, condition, random);
      for (const double offset : kOffsets) {
        // The start differs from the truth by moves of the corners in the template.
        const Matrix3d moved = test::random_homography(trial.planar_template, offset, random);
        run_trial(trial, condition, trial.H_cur_ref * moved, offset, study);
      }
    }
    std::fprintf(stderr, "trial %d of %d\n", i + 1, trials);
  }
  const std::string prefix = argv[1], text = table(study);
  std::ofstream(prefix + ".tsv") << text;
  std::fputs(text.c_str(), stdout);
  draw(prefix, study);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc, argv);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
