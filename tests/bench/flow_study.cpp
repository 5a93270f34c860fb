// Optical flow of every method against the exact flow of rendered frames, and what is read from it:
// the motion of patches of planes, time to contact, speed over height.
//   bench_flow_study OUT_PREFIX [FRAMES=6]
// writes OUT_PREFIX.md (tables) and OUT_PREFIX_targets.tsv (figure, tab, value).
#include <fmt/format.h>
#include <placegraph/eval/scene/flow_error.h>
#include <placegraph/frontend/flow/flow_cues.h>
#include <placegraph/frontend/flow/interpolation_flow.h>
#include <placegraph/frontend/flow/optical_flow.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <opencv2/video/tracking.hpp>

#include "tests/support/scenes/texture.h"

namespace {

using namespace placegraph;
using Eigen::Vector2d;
using Eigen::Vector3d;

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Report {
  std::string markdown, targets;
  void target(const std::string& figure, double value) {
    targets += fmt::format("{}\t{:.4g}\n", figure, value);
  }
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

struct Motion {
  const char* name;
  FlowRange range;
};
const std::vector<Motion> kMotions = {{"small, below 2 px", {0, 2}},
                                      {"medium, 2 to 10 px", {2, 10}},
                                      {"large, above 10 px", {10, 1e9}}};

/// Mean end-point errors of two methods where both answer.
std::pair<double, double> common_error(const Image& a, const Image& b, const Image& truth) {
  Image both = truth.clone();
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u)
      if (std::isnan(a.at<cv::Vec2f>(v, u)[0]) || std::isnan(b.at<cv::Vec2f>(v, u)[0]))
        both.at<cv::Vec2f>(v, u) = {NAN, NAN};
  return {flow_error(a, both).mean_px, flow_error(b, both).mean_px};
}

/// Every method on `frames` frames spread over a rendered world.
void study_world(const std::string& name, int frames, Report& report) {
  SyntheticOptions options;
  options.world = name;
  const SyntheticWorld world(options);
  SyntheticContents contents;
  contents.flow = true;
  struct Tally {
    std::vector<double> mean_px, median_px, coverage;
  };
  std::map<std::pair<std::size_t, std::size_t>, Tally> tallies;  // motion, method
  std::vector<double> cost_ms(flow_method_names().size(), 0), ours, opencv;
  for (int k = 0; k < frames; ++k) {
    const std::size_t at = (2 * static_cast<std::size_t>(k) + 1) * world.size() /
                           (2 * static_cast<std::size_t>(frames) + 1);
    const SyntheticFrame frame = world.render(at, contents);
    const Image next = world.render(at + 1, {}).frame.image;
    std::vector<Image> found;
    for (std::size_t m = 0; m < flow_method_names().size(); ++m) {
      FlowOptions flow;
      flow.method = static_cast<FlowMethod>(m);
      const double before = cpu_s();
      found.push_back(optical_flow(frame.frame.image, next, flow));
      cost_ms[m] += 1e3 * (cpu_s() - before) / frames;
      for (std::size_t i = 0; i < kMotions.size(); ++i) {
        const FlowError error = flow_error(found.back(), frame.flow, kMotions[i].range);
        if (error.compared < 20) continue;
        Tally& tally = tallies[{i, m}];
        tally.mean_px.push_back(error.mean_px);
        tally.median_px.push_back(error.median_px);
        tally.coverage.push_back(error.coverage);
      }
    }
    const auto [a, b] =
        common_error(found[static_cast<std::size_t>(FlowMethod::kLucasKanade)],
                     found[static_cast<std::size_t>(FlowMethod::kOpencvLucasKanade)], frame.flow);
    ours.push_back(a);
    opencv.push_back(b);
  }
  for (std::size_t i = 0; i < kMotions.size(); ++i)
    for (std::size_t m = 0; m < flow_method_names().size(); ++m) {
      const Tally& tally = tallies[{i, m}];
      if (tally.mean_px.empty()) continue;
      report.markdown += fmt::format("| {} | {} | {} | {:.3f} | {:.3f} | {:.1f} | {:.0f} |\n", name,
                                     kMotions[i].name, flow_method_names()[m], mean(tally.mean_px),
                                     mean(tally.median_px), 100 * mean(tally.coverage), cost_ms[m]);
    }
  report.target("lucas-kanade over OpenCV's, " + name, mean(ours) / mean(opencv));
}

/// Patches of a plane that faces the camera, shifted by up to four pixels, with noise of one grey
/// level: RMS of each coordinate's error, and time a patch.
void study_patches(Report& report) {
  constexpr int kSide = 320, kPairs = 12;
  std::map<std::string, std::vector<double>> squares;
  std::map<std::string, double> cost_s;
  std::map<std::string, int> predictions;
  Random random(7);
  int patches = 0;
  for (int pair = 0; pair < kPairs; ++pair) {
    const test::Texture texture{.seed = 50 + static_cast<std::uint64_t>(pair),
                                .wavelength = 24,
                                .octaves = 3,
                                .contrast = 40};
    const double angle = random.uniform(0, 2 * CV_PI), length = 4.0 * (pair + 1) / kPairs;
    const Vector2d flow = length * Vector2d(std::cos(angle), std::sin(angle));
    const Image from = test::disturbed(test::texture_image(kSide, kSide, texture), 1, random);
    const Image to = test::disturbed(
        test::texture_image(kSide, kSide, texture, -flow.x(), -flow.y()), 1, random);
    std::vector<Vector2d> points;
    for (const Vector2d& px : flow_grid(kSide, kSide, 8))
      if (px.minCoeff() > 24 && px.maxCoeff() < kSide - 24) points.push_back(px);
    patches += static_cast<int>(points.size());
    const auto count = [&](const std::string& name, double seconds,
                           const std::vector<FlowVector>& vectors) {
      cost_s[name] += seconds;
      for (const FlowVector& vector : vectors) {
        if (vector.kind != FlowVector::Kind::kFull) continue;
        ++predictions[name];
        squares[name].push_back((vector.flow - flow).squaredNorm() / 2);
      }
    };
    double before = cpu_s();
    auto vectors = interpolation_flow(from, to, points, {});
    count("interpolation", cpu_s() - before, vectors);
    LucasKanadeOptions forward_only;
    forward_only.max_return_error_px = 0;
    before = cpu_s();
    vectors = lucas_kanade(from, to, points, forward_only);
    count("lucas-kanade", cpu_s() - before, vectors);
    std::vector<cv::Point2f> start, end;
    for (const Vector2d& px : points)
      start.emplace_back(static_cast<float>(px.x()), static_cast<float>(px.y()));
    std::vector<unsigned char> status;
    std::vector<float> error;
    before = cpu_s();
    cv::calcOpticalFlowPyrLK(from, to, start, end, status, error);
    const double seconds = cpu_s() - before;
    vectors.clear();
    for (std::size_t i = 0; i < start.size(); ++i) {
      FlowVector vector;
      vector.kind = status[i] ? FlowVector::Kind::kFull : FlowVector::Kind::kNone;
      vector.flow = {end[i].x - start[i].x, end[i].y - start[i].y};
      vectors.push_back(vector);
    }
    count("opencv-lucas-kanade", seconds, vectors);
  }
  for (const char* name : {"interpolation", "lucas-kanade", "opencv-lucas-kanade"}) {
    const double rms = std::sqrt(mean(squares[name])), us = 1e6 * cost_s[name] / patches;
    report.markdown += fmt::format("| {} | {:.4f} | {:.1f} | {:.1f} |\n", name, rms,
                                   100.0 * predictions[name] / patches, us);
    report.target(fmt::format("patches, RMS [px], {}", name), rms);
    report.target(fmt::format("patches, us, {}", name), us);
  }
}

const Camera kCamera{.width = 640, .height = 480, .fx = 450, .fy = 450, .cx = 319.5, .cy = 239.5};

/// A smooth scene: planes with soft texture, the camera passing by.
void study_smooth(Report& report) {
  std::vector<double> smooth, farneback;
  for (int k = 0; k < 4; ++k) {
    const test::TexturedPlane plane{
        SE3(SO3::exp({0.3 * (k % 2), -0.2 * (k / 2), 0}), Vector3d(0, 0, 4)),
        1e3,
        1e3,
        {.seed = 30 + static_cast<std::uint64_t>(k),
         .wavelength = 0.5,
         .octaves = 2,
         .contrast = 60}};
    const SE3 T_1_2(SO3::exp({0.002, -0.004, 0.01}), Vector3d(0.02 * k, 0.01, 0.03));
    const test::Picture from = test::render(kCamera, {}, {plane});
    const test::Picture to = test::render(kCamera, T_1_2, {plane});
    Image truth(kCamera.height, kCamera.width, CV_32FC2);
    for (int v = 0; v < kCamera.height; ++v)
      for (int u = 0; u < kCamera.width; ++u) {
        const Vector3d ray = *kCamera.unproject({u, v});
        const auto px = kCamera.project(T_1_2.inverse() * (from.depth.at<float>(v, u) * ray));
        truth.at<cv::Vec2f>(v, u) =
            px ? cv::Vec2f(static_cast<float>(px->x() - u), static_cast<float>(px->y() - v))
               : cv::Vec2f(NAN, NAN);
      }
    FlowOptions options;
    options.method = FlowMethod::kHornSchunck;
    smooth.push_back(flow_error(optical_flow(from.grey, to.grey, options), truth).mean_px);
    options.method = FlowMethod::kFarneback;
    farneback.push_back(flow_error(optical_flow(from.grey, to.grey, options), truth).mean_px);
  }
  report.target("smooth scenes, mean error [px], horn-schunck", mean(smooth));
  report.target("smooth scenes, mean error [px], farneback", mean(farneback));
}

/// Straight towards a wall at 2 m/s and 10 Hz while the camera sways: contact in 10 s to 1 s.
void study_approach(Report& report) {
  constexpr double kSpeed = 2, kPeriod_s = 0.1;
  const test::TexturedPlane wall{SE3(SO3(), Vector3d(0, 0, 0)),
                                 1e3,
                                 1e3,
                                 {.seed = 4, .wavelength = 4, .octaves = 10, .contrast = 40}};
  const auto pose = [&](double contact_s) {
    return SE3(SO3::exp({0.01 * std::sin(3 * contact_s), 0.01 * std::cos(2 * contact_s), 0}),
               Vector3d(0, 0, -kSpeed * contact_s));
  };
  std::vector<double> errors;
  for (double contact_s = 10; contact_s >= 0.99; contact_s -= 0.5) {
    const SE3 T_wall_1 = pose(contact_s + kPeriod_s), T_wall_2 = pose(contact_s);
    const Image from = test::render(kCamera, T_wall_1, {wall}).grey;
    const Image to = test::render(kCamera, T_wall_2, {wall}).grey;
    const auto flow = lucas_kanade(from, to, flow_grid(kCamera.width, kCamera.height, 24), {});
    const KnownRotation camera_rotation{T_wall_1.rotation().inverse() * T_wall_2.rotation()};
    const Vector3d normal = T_wall_1.rotation().inverse() * Vector3d::UnitZ();
    const TimeToContact contact = time_to_contact(
        ventral_motion(derotate(kCamera, flow, camera_rotation), normal), normal, kPeriod_s);
    errors.push_back(contact.outcome ? std::abs(contact.seconds / contact_s - 1) : 1);
  }
  report.target("time to contact, worst error [%]",
                100 * *std::max_element(errors.begin(), errors.end()));
}

/// Over a floor at 0.5 to 3 m with known turns: speed over height.
void study_ventral(Report& report) {
  const test::TexturedPlane floor{
      SE3(), 1e3, 1e3, {.seed = 6, .wavelength = 1, .octaves = 9, .contrast = 40}};
  std::vector<double> errors;
  for (const double height : {0.5, 1.0, 2.0, 3.0})
    for (const double speed_over_height : {0.1, 0.4, 1.0}) {
      constexpr double kPeriod_s = 0.05;
      const Vector3d path(speed_over_height * height * kPeriod_s,
                          0.3 * speed_over_height * height * kPeriod_s, 0);
      const SE3 T_floor_1(SO3::exp({0.05, -0.03, 0}), Vector3d(0, 0, -height));
      const SE3 T_floor_2(SO3::exp({0.04, -0.01, 0.02}), T_floor_1.translation() + path);
      const Image from = test::render(kCamera, T_floor_1, {floor}).grey;
      const Image to = test::render(kCamera, T_floor_2, {floor}).grey;
      const auto flow = lucas_kanade(from, to, flow_grid(kCamera.width, kCamera.height, 24), {});
      const KnownRotation camera_rotation{T_floor_1.rotation().inverse() * T_floor_2.rotation()};
      const Vector3d normal = T_floor_1.rotation().inverse() * Vector3d::UnitZ();
      const VentralMotion motion = ventral_motion(derotate(kCamera, flow, camera_rotation), normal);
      const Vector3d truth = T_floor_1.rotation().inverse() * path / height;
      errors.push_back(motion.outcome ? (motion.over_distance - truth).norm() / truth.norm() : 1);
    }
  report.target("speed over height, worst error [%]",
                100 * *std::max_element(errors.begin(), errors.end()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_flow_study OUT_PREFIX [FRAMES=6]\n");
    return 2;
  }
  const std::string prefix = argv[1];
  const int frames = argc > 2 ? std::atoi(argv[2]) : 6;
  Report report;
  report.markdown =
      "| world | true motion | method | mean error [px] | median [px] | covered [%] | CPU [ms] |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const char* world : {"town-loop", "corridor-loop", "flight"})
    study_world(world, frames, report);
  report.markdown +=
      "\n| method | RMS a coordinate [px] | answered [%] | CPU a patch [us] |\n|---|---|---|---|\n";
  study_patches(report);
  study_smooth(report);
  study_approach(report);
  study_ventral(report);
  std::ofstream(prefix + ".md") << report.markdown;
  std::ofstream(prefix + "_targets.tsv") << report.targets;
  std::fputs((report.markdown + "\n" + report.targets).c_str(), stdout);
  return 0;
}
