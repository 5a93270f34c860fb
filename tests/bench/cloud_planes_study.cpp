// Planes in point clouds with known labels: found by each method, with and without noise added.
//   bench_cloud_planes_study castle FOLDER | synpeb FILE | generated SEED
#include <fmt/format.h>
#include <placegraph/eval/scene/plane_check.h>
#include <placegraph/frontend/cloud_planes/cloud_planes.h>
#include <placegraph/frontend/cloud_planes/planarity_model.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/measurements/point_cloud_file.h>
#include <placegraph/io/synthetic/worlds/cloud_scene.h>

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
           double sigma_share, int min_points) {
  for (const auto& [name, method] : kMethods) {
    CloudPlanesOptions options;
    options.method = method;
    const PlanarityModel planarity = built_in_planarity();
    PlaneCheck all;
    std::vector<double> angles, cpu;
    for (const Sample& sample : samples) {
      Random random(7);
      const PointCloud cloud = with_noise(sample.cloud, sigma_m, sigma_share, random);
      const std::clock_t begin = std::clock();
      const CloudPlanesResult result = find_cloud_planes(cloud, options, planarity);
      cpu.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
      const PlaneCheck check = check_planes(sample.truth, result.labels, {0.8, min_points});
      all.truth += check.truth, all.correct += check.correct, all.missed += check.missed;
      all.over_segmented += check.over_segmented, all.under_segmented += check.under_segmented;
      all.noise += check.noise;
      for (const PlaneCheckMatch& match : check.matches) {
        const auto normal = sample.normals.find(match.truth);
        if (match.found == 0 || normal == sample.normals.end()) continue;
        const Eigen::Vector3d& n = result.planes[match.found - 1].plane.normal;
        angles.push_back(rad_to_deg(std::asin(std::min(1.0, n.cross(normal->second).norm()))));
      }
    }
    const auto number = [](std::vector<double> values, double share) {
      if (values.empty()) return 0.0;
      std::sort(values.begin(), values.end());
      return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    const double noise = sigma_m > 0 ? 1e3 * sigma_m : 100 * sigma_share;
    fmt::print("{}\t{:g}\t{}\t{}\t{}\t{:.3f}\t{:.3f}\t{}\t{}\t{}\t{:.3f}\t{:.3f}\t{:.0f}\n", data,
               noise, name, all.truth, all.correct, all.correct_share(),
               all.over_segmented_per_plane(), all.under_segmented, all.missed, all.noise,
               number(angles, 0.5), number(angles, 1), number(cpu, 0.5));
  }
}

int run(const std::vector<std::string>& arguments) {
  require(arguments.size() >= 2,
          "bench_cloud_planes_study castle FOLDER | synpeb FILE | generated SEED");
  const bool castle = arguments[0] == "castle";
  const std::vector<Sample> samples = castle                     ? read_castle(arguments[1])
                                      : arguments[0] == "synpeb" ? read_synpeb(arguments[1])
                                      : arguments[0] == "generated"
                                          ? generate(std::stoull(arguments[1]))
                                          : std::vector<Sample>{};
  require(!samples.empty(), arguments[0] + ": no such data");
  fmt::print(
      "data\tnoise\tmethod\tplanes\tcorrect\tshare\tover_a_plane\tunder\tmissed\tfalse\t"
      "normal_median_deg\tnormal_worst_deg\tcpu_ms\n");
  for (const double noise : {0.0, 1.0, 2.0})
    study(samples, arguments[0], castle ? 1e-3 * noise : 0, castle ? 0 : 1e-2 * noise,
          castle ? 300 : 100);
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
