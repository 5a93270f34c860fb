// How far from the truth direct alignment of a planar template may start: the share of trials that
// end within a pixel (photographs: three, their homographies are known to half a pixel), against
// the offset of the corners at the start, for every optimizer and similarity, as it is and under
// another illumination, blur and 30 % occlusion. Starts are views that a camera may have: with the
// corners of a convex quadrilateral. On rendered templates also how many steps ESM takes from 4 px
// to a hundredth pixel, and how much further than ESM alone swarm and ESM reach.
//   bench_align_study OUT_PREFIX [TRIALS=20] [PLANAR_HOMOGRAPHY_FOLDER]
// writes OUT_PREFIX.md, OUT_PREFIX_optimizers.png, OUT_PREFIX_similarities.png and, of rendered
// templates, OUT_PREFIX_targets.tsv.
#include <fmt/format.h>
#include <placegraph/frontend/align/aligner.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "tests/bench/rate_plot.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes/warped_template.h"

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
constexpr double kSearchStep_px =
    8;  // searches cost a hundred times as much: at every second offset

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
  Image image = test::read_grey_picture(path);
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

/// A move of the template's corners by `offset_px` each, after which the trial's camera would still
/// see them as a convex quadrilateral.
Matrix3d visible_move(const Trial& trial, double offset_px, Random& random) {
  const auto& corners = trial.planar_template.corners_px();
  for (;;) {
    const Matrix3d moved = test::random_homography(trial.planar_template, offset_px, random);
    auto seen = corners;
    bool in_front = true;
    for (Vector2d& corner : seen) {
      const auto px = map_pixel(trial.H_cur_ref * moved, corner);
      in_front = in_front && px;
      if (px) corner = *px;
    }
    if (in_front && homography_of_box(corners, seen)) return moved;
  }
}

bool searches(AlignOptimizer optimizer) {
  return optimizer == AlignOptimizer::kSwarm || optimizer == AlignOptimizer::kGenetic ||
         optimizer == AlignOptimizer::kSwarmEsm;
}

void run_trial(const Trial& trial, std::size_t condition, const Matrix3d& start, double offset,
               Study& study) {
  for (int optimizer = 0; optimizer < kOptimizers; ++optimizer) {
    if (searches(static_cast<AlignOptimizer>(optimizer)) && std::fmod(offset, kSearchStep_px) != 0)
      continue;
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
      if (error_px < trial.tolerance_px)
        ++tally.converged;
      else
        tally.confident += result.outcome ? 1 : 0;
    }
  }
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

/// The largest offset up to which at least 90 % of the trials converged, at every offset below it
/// too; 0 for none.
double offset_at_90(const Study& study, std::size_t condition, int optimizer,
                    Similarity similarity) {
  double reached = 0;
  for (const auto& [key, tally] : study) {
    const auto& [c, o, s, offset] = key;
    if (c != condition || o != optimizer || s != static_cast<int>(similarity)) continue;
    if (tally.rate() < 0.9) break;
    reached = offset;
  }
  return reached;
}

/// Rows of Markdown: optimizer, similarity, that offset under each condition, what was wrong though
/// the outcome was ok, time.
std::string reach_table(const Study& study) {
  std::string text = "| optimizer | similarity |";
  for (const std::string& condition : kConditions) text += " " + condition + " |";
  text += " wrong but ok | CPU [ms] |\n|---|---|---|---|---|---|---|---|\n";
  for (int optimizer = 0; optimizer < kOptimizers; ++optimizer)
    for (const Similarity similarity : kSimilarities) {
      text +=
          fmt::format("| {} | {} |", align_optimizer_names()[static_cast<std::size_t>(optimizer)],
                      similarity_names()[static_cast<std::size_t>(similarity)]);
      int trials = 0, confident = 0;
      double cpu_s = 0;
      for (const auto& [key, tally] : study) {
        if (std::get<1>(key) != optimizer || std::get<2>(key) != static_cast<int>(similarity))
          continue;
        trials += tally.trials, confident += tally.confident, cpu_s += tally.cpu_s;
      }
      for (std::size_t condition = 0; condition < kConditions.size(); ++condition)
        text += fmt::format(" {:g} |", offset_at_90(study, condition, optimizer, similarity));
      text +=
          fmt::format(" {:.1f} % | {:.1f} |\n", 100.0 * confident / trials, 1e3 * cpu_s / trials);
    }
  return text;
}

/// Steps of ESM on full resolution, without noise, until all corners are within 0.01 px, from 4 px.
std::string precision_rows() {
  std::vector<int> steps;
  std::vector<double> after_six;
  for (int i = 0; i < 40; ++i) {
    Random random(5000, static_cast<std::uint64_t>(i));
    const test::Texture texture{random.next(), 40, 4, 40, 128};
    const PlanarTemplate t(test::texture_image(kWidth, kHeight, texture), square_at({80, 60}), 1,
                           kSide * kSide);
    const Matrix3d H = test::random_homography(t, 4, random);
    const auto pyramid = grey_pyramid(test::warped_texture(kWidth, kHeight, texture, H), 1);
    int needed = 99;
    for (int limit = 1; limit <= 12; ++limit) {
      GradientAlignmentOptions options;
      options.iterations = limit;
      const auto end = align_level(t, pyramid[0], 0, t.homography(Matrix3d::Identity()),
                                   Gradients::kEsm, options);
      const double error_px = t.corner_distance_px(end.warp.H_cur_ref(), H);
      if (limit == 6) after_six.push_back(error_px);
      if (error_px <= 0.01 && needed == 99) needed = limit;
    }
    steps.push_back(needed);
  }
  std::sort(steps.begin(), steps.end());
  std::sort(after_six.begin(), after_six.end());
  const auto within =
      std::count_if(steps.begin(), steps.end(), [](int needed) { return needed <= 6; });
  return fmt::format(
      "steps of ESM to 0.01 px from 4 px, median of {}\t{}\n"
      "share within 6 steps [%]\t{:.0f}\n"
      "error after 6 steps, median [px]\t{:.4f}\n",
      steps.size(), steps[steps.size() / 2],
      100.0 * static_cast<double>(within) / static_cast<double>(steps.size()),
      after_six[after_six.size() / 2]);
}

/// How far ESM and swarm with ESM reach with 60 trials an offset.
std::string reach_rows() {
  Study study;
  const std::vector<AlignOptimizer> both = {AlignOptimizer::kEsm, AlignOptimizer::kSwarmEsm};
  for (int i = 0; i < 60; ++i) {
    Random random(6000, static_cast<std::uint64_t>(i));
    const Trial trial = rendered(random);
    for (double offset = 10; offset <= 46; offset += 3) {
      const auto start =
          trial.planar_template.homography(trial.H_cur_ref * visible_move(trial, offset, random));
      for (const AlignOptimizer optimizer : both) {
        AlignOptions options;
        options.optimizer = optimizer;
        const AlignResult result = align(trial.planar_template, trial.image, start, options);
        Tally& tally =
            study[{0, static_cast<int>(optimizer), static_cast<int>(Similarity::kZncc), offset}];
        ++tally.trials;
        tally.converged +=
            trial.planar_template.corner_distance_px(result.warp.H_cur_ref(), trial.H_cur_ref) < 1;
      }
    }
  }
  const double alone = offset_at_90(study, 0, static_cast<int>(both[0]), Similarity::kZncc);
  const double hybrid = offset_at_90(study, 0, static_cast<int>(both[1]), Similarity::kZncc);
  return fmt::format("esm at 90 % [px]\t{:g}\nswarm_esm at 90 % [px]\t{:g}\nratio\t{:.2f}\n", alone,
                     hybrid, hybrid / alone);
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  require(file.good(), path + ": cannot be written");
}

void run(int argc, char** argv) {
  require(argc >= 2 && argc <= 4, "bench_align_study OUT_PREFIX [TRIALS] [FOLDER]");
  const int trials = argc > 2 ? std::atoi(argv[2]) : 20;
  require(trials > 0, "TRIALS must be positive");
  const std::string prefix = argv[1];
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
        const Matrix3d moved = visible_move(trial, offset, random);
        run_trial(trial, condition, trial.H_cur_ref * moved, offset, study);
      }
    }
    std::fprintf(stderr, "trial %d of %d\n", i + 1, trials);
    // A study that is cut short leaves what it has.
    write_text(prefix + ".md", reach_table(study));
    draw(prefix, study);
  }
  if (photographs.empty()) write_text(prefix + "_targets.tsv", precision_rows() + reach_rows());
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
