// Planes in point clouds with known labels: found by each method, with and without noise added.
//   bench_cloud_planes_study castle FOLDER | synpeb FILE | world NAME | generated SEED
#include <fmt/format.h>
#include <placegraph/eval/internal/scene/plane_check.h>
#include <placegraph/frontend/internal/cloud_planes/cloud_planes.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/internal/core/angle.h>
#include <placegraph/graph/internal/core/median.h>
#include <placegraph/graph/internal/core/random.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/internal/files/text_file.h>
#include <placegraph/io/internal/measurements/point_cloud_file.h>
#include <placegraph/io/internal/synthetic/worlds/cloud_scene.h>
#include <placegraph/io/internal/synthetic/worlds/synthetic_world.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

namespace fs = std::filesystem;

const std::vector<std::pair<const char*, CloudPlanesMethod>> kMethods = {
    {"cuts", CloudPlanesMethod::kCuts},
    {"ransac", CloudPlanesMethod::kRansac},
    {"growing", CloudPlanesMethod::kGrowing}};

/// A cloud with the true plane of every point, and the normals of planes where they are known.
struct Sample {
  std::string name;
  PointCloud cloud;
  std::vector<int> truth;
  std::map<int, Eigen::Vector3d> normals;
};

Eigen::Matrix4d read_pose(const std::string& path) {
  TextFile file(path);
  Eigen::Matrix4d matrix;
  std::string_view line;
  std::vector<std::string_view> fields;
  for (int row = 0; row < 4 && file.next_data(line); ++row) {
    split_blank(line, fields);
    for (int k = 0; k < 4; ++k) matrix(row, k) = file.number(fields.at(k), "pose");
  }
  return matrix;
}

/// Coplanar faces are one plane; window and door count with the walls that they stand before.
int castle_plane(int label) { return label == 4 ? 3 : label == 14 ? 5 : label == 15 ? 7 : label; }

std::vector<Sample> read_castle(const std::string& folder) {
  constexpr double kStep = 1.0 / 32768;
  const Camera camera{.width = 640, .height = 480, .fx = 700, .fy = 700, .cx = 319.5, .cy = 239.5};
  std::map<int, Eigen::Vector3d> normals;
  TextFile planes(folder + "/planes_object_frame.txt");
  std::string_view line;
  std::vector<std::string_view> fields;
  while (planes.next_data(line)) {
    split_blank(line, fields);
    normals[static_cast<int>(planes.integer(fields.at(0), "id"))] = {
        planes.number(fields.at(1), "nx"), planes.number(fields.at(2), "ny"),
        planes.number(fields.at(3), "nz")};
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder + "/depth")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Sample> samples;
  for (const fs::path& file : files) {
    Sample sample;
    sample.name = file.stem();
    sample.cloud = cloud_of_depth(read_depth(file, kStep), camera, kStep);
    const Image labels = read_image_as_stored(folder + "/plane_labels/" + sample.name + ".png");
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x)
        sample.truth.push_back(castle_plane(labels.at<unsigned char>(y, x)));
    const Eigen::Matrix4d pose = read_pose(folder + "/pose/" + sample.name + ".txt");
    for (const auto& [id, normal] : normals)
      sample.normals[id] = (pose.topLeftCorner<3, 3>() * normal).normalized();
    samples.push_back(std::move(sample));
  }
  return samples;
}

std::vector<Sample> read_synpeb(const std::string& file) {
  constexpr int kLeftOver = 3;
  Sample sample;
  sample.name = fs::path(file).stem();
  sample.cloud = read_point_cloud(file);
  sample.truth = read_point_labels(file);
  for (int& label : sample.truth)
    if (label == kLeftOver) label = 0;
  return {sample};
}

/// Frames of a rendered world.
std::vector<Sample> render_world(const std::string& name) {
  constexpr std::size_t kFrames = 12;
  SyntheticOptions options;
  options.world = name;
  options.seed = 77;
  const SyntheticWorld world(options);
  // Faces in one plane are one.
  const auto planes = world.planes();
  std::vector<int> same_plane(planes.size(), 0);
  for (std::size_t a = 1; a < planes.size(); ++a)
    for (std::size_t b = 1; b <= a && same_plane[a] == 0; ++b)
      if ((planes[a] - planes[b]).norm() < 1e-4 || (planes[a] + planes[b]).norm() < 1e-4)
        same_plane[a] = static_cast<int>(b);
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < kFrames; ++k) {
    const SyntheticFrame seen =
        world.render(world.size() * k / kFrames, {.depth = true, .planes = true});
    Sample sample;
    sample.name = fmt::format("{} {}", name, k);
    sample.cloud = cloud_of_depth(seen.frame.depth, world.calibration().camera, 0);
    sample.truth.assign(seen.planes.begin<std::uint16_t>(), seen.planes.end<std::uint16_t>());
    for (int& label : sample.truth) label = same_plane[static_cast<std::size_t>(label)];
    samples.push_back(std::move(sample));
  }
  return samples;
}

std::vector<Sample> generate(std::uint64_t seed) {
  constexpr std::uint64_t kClouds = 20, kStream = 1'000'000;  // none that models are trained on
  std::vector<Sample> samples;
  for (std::uint64_t k = 0; k < kClouds; ++k) {
    Random random(seed, kStream + k);
    synthetic::LabelledCloud cloud = synthetic::random_cloud(random);
    samples.push_back({fmt::format("cloud {}", k), std::move(cloud.cloud), cloud.labels, {}});
  }
  return samples;
}

/// Along the ray, in metres or in shares of the range.
PointCloud with_noise(PointCloud cloud, double sigma_m, double sigma_share, Random& random) {
  for (Eigen::Vector3d& p : cloud.points) {
    if (!p.allFinite()) continue;
    const double depth = cloud.organised() ? p.z() : p.norm();
    p *= 1 + (random.normal(0, sigma_m) / depth + random.normal(0, sigma_share));
  }
  return cloud;
}

void study(const std::vector<Sample>& samples, const std::string& data, double sigma_m,
           double sigma_share, int min_points, bool verbose) {
  for (const auto& [name, method] : kMethods) {
    CloudPlanesOptions options;
    options.method = method;
    const PlanarityModel planarity = built_in_planarity();
    PlaneCheck all;
    std::vector<double> angles, cpu;
    int found = 0;
    for (const Sample& sample : samples) {
      Random random(7);
      const PointCloud cloud = with_noise(sample.cloud, sigma_m, sigma_share, random);
      const std::clock_t begin = std::clock();
      const CloudPlanesResult result = find_cloud_planes(cloud, options, planarity);
      cpu.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
      if (verbose && method == CloudPlanesMethod::kCuts)
        fmt::print(stderr, "{}: noise {:.3g} power {} least {:.3g} at 0.9 {:.3g}\n", sample.name,
                   result.noise.at_1m, result.noise.power, result.noise.least_m,
                   result.noise.sigma(0.9));
      const PlaneCheck check = check_planes(sample.truth, result.labels, {0.8, min_points});
      found += static_cast<int>(result.planes.size());
      all.truth += check.truth, all.correct += check.correct, all.missed += check.missed;
      all.over_segmented += check.over_segmented, all.under_segmented += check.under_segmented;
      all.noise += check.noise, all.extra_pieces += check.extra_pieces;
      for (const PlaneCheckMatch& match : check.matches) {
        if (verbose && match.found == 0 && method == CloudPlanesMethod::kCuts) {
          std::map<int, int> segments;
          for (std::size_t i = 0; i < sample.truth.size(); ++i)
            if (sample.truth[i] == match.truth) ++segments[result.labels[i]];
          std::string text;
          for (const auto& [label, n] : segments)
            text +=
                fmt::format(" {}:{}/{}", label, n, label > 0 ? result.planes[label - 1].points : 0);
          fmt::print(stderr, "{} missed {} of {} points:{}\n", sample.name, match.truth,
                     match.points, text);
        }
        const auto normal = sample.normals.find(match.truth);
        if (match.found == 0 || normal == sample.normals.end()) continue;
        const Eigen::Vector3d& n = result.planes[match.found - 1].plane.normal;
        angles.push_back(rad_to_deg(std::asin(std::min(1.0, n.cross(normal->second).norm()))));
        if (verbose && angles.back() > 1 && method == CloudPlanesMethod::kCuts)
          fmt::print(stderr, "{}: plane {} of {} points is {:.2f} deg off\n", sample.name,
                     match.truth, match.points, angles.back());
      }
    }
    const auto number = [](std::vector<double> values, double share) {
      if (values.empty()) return 0.0;
      std::sort(values.begin(), values.end());
      return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    const double noise = sigma_m > 0 ? 1e3 * sigma_m : 100 * sigma_share;
    fmt::print("{}\t{:g}\t{}\t{}\t{}\t{:.3f}\t{:.3f}\t{}\t{}\t{}\t{}\t{:.3f}\t{:.3f}\t{:.0f}\t{}\n",
               data, noise, name, all.truth, all.correct, all.correct_share(),
               all.over_segmented_per_plane(), all.extra_pieces, all.under_segmented, all.missed,
               all.noise, number(angles, 0.5), number(angles, 1), number(cpu, 0.5), found);
  }
}

int run(const std::vector<std::string>& arguments) {
  require(arguments.size() >= 2,
          "bench_cloud_planes_study castle FOLDER | synpeb FILE | world NAME | generated SEED");
  const bool castle = arguments[0] == "castle", verbose = arguments.size() > 2;
  const std::vector<Sample> samples = castle                     ? read_castle(arguments[1])
                                      : arguments[0] == "synpeb" ? read_synpeb(arguments[1])
                                      : arguments[0] == "world"  ? render_world(arguments[1])
                                      : arguments[0] == "generated"
                                          ? generate(std::stoull(arguments[1]))
                                          : std::vector<Sample>{};
  require(!samples.empty(), arguments[0] + ": no such data");
  fmt::print(
      "data\tnoise\tmethod\tplanes\tcorrect\tshare\tover_a_plane\textra\tunder\tmissed\tfalse\t"
      "normal_median_deg\tnormal_worst_deg\tcpu_ms\tfound\n");
  for (const double noise : {0.0, 1.0, 2.0})
    study(samples, arguments[0], castle ? 1e-3 * noise : 0, castle ? 0 : 1e-2 * noise,
          castle ? 300 : 100, verbose);
  return 0;
}

}  // namespace
}  // namespace placegraph

int main(int argc, char** argv) {
  try {
    return placegraph::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_cloud_planes_study: %s\n", error.what());
    return 2;
  }
}
