#include <placegraph/frontend/places/code_database.h>
#include <placegraph/frontend/places/landmarks.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Mode that a point climbs to among the others.
Eigen::Vector2f mode_of(Eigen::Vector2f point, const std::vector<Eigen::Vector2f>& positions,
                        float radius) {
  // Iterations at most. Chosen.
  constexpr int kRounds = 30;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Vector2f sum = Eigen::Vector2f::Zero();
    int count = 0;
    for (const Eigen::Vector2f& position : positions)
      if ((position - point).squaredNorm() <= radius * radius) {
        sum += position;
        ++count;
      }
    if (count == 0) break;
    const Eigen::Vector2f mean = sum / static_cast<float>(count);
    const bool rests = (mean - point).norm() < 0.01f * radius;
    point = mean;
    if (rests) break;
  }
  return point;
}

}  // namespace

std::vector<int> group_positions(const std::vector<Eigen::Vector2f>& positions, double bandwidth) {
  require(bandwidth > 0, "group_positions: bandwidth > 0 needed");
  const auto radius = static_cast<float>(bandwidth);
  std::vector<Eigen::Vector2f> modes;
  std::vector<int> group;
  for (const Eigen::Vector2f& position : positions) {
    const Eigen::Vector2f mode = mode_of(position, positions, radius);
    const auto known = std::find_if(modes.begin(), modes.end(), [&](const Eigen::Vector2f& m) {
      return (m - mode).norm() < radius / 2;
    });
    group.push_back(static_cast<int>(known - modes.begin()));
    if (known == modes.end()) modes.push_back(mode);
  }
  return group;
}

std::vector<ImageLandmark> find_landmarks(const FloatFeatures& features,
                                          const std::vector<LlcCode>& codes, int words,
                                          const LandmarkOptions& options) {
  require(features.position.size() == codes.size(), "find_landmarks: a code per feature needed");
  const std::vector<int> group = group_positions(features.position, options.bandwidth);
  const int groups = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
  std::vector<std::vector<LlcCode>> codes_of(static_cast<std::size_t>(groups));
  std::vector<ImageLandmark> landmarks(static_cast<std::size_t>(groups));
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const auto g = static_cast<std::size_t>(group[i]);
    codes_of[g].push_back(codes[i]);
    landmarks[g].centre += features.position[i];
    ++landmarks[g].features;
  }
  for (std::size_t g = 0; g < landmarks.size(); ++g) {
    landmarks[g].centre /= static_cast<float>(landmarks[g].features);
    landmarks[g].code = max_pooled(codes_of[g], words);
  }
  std::erase_if(landmarks,
                [&](const ImageLandmark& l) { return l.features < options.min_features; });
  std::stable_sort(
      landmarks.begin(), landmarks.end(),
      [](const ImageLandmark& a, const ImageLandmark& b) { return a.features > b.features; });
  if (landmarks.size() > static_cast<std::size_t>(options.max_landmarks))
    landmarks.resize(static_cast<std::size_t>(options.max_landmarks));
  return landmarks;
}

double landmark_similarity(const std::vector<ImageLandmark>& query,
                           const std::vector<ImageLandmark>& stored, double max_shift) {
  const auto limit = static_cast<float>(max_shift * max_shift);
  double sum = 0, weights = 0;
  for (const ImageLandmark& a : query) {
    float best = 0;
    for (const ImageLandmark& b : stored)
      if ((a.centre - b.centre).squaredNorm() <= limit) best = std::max(best, a.code.dot(b.code));
    const double weight = std::sqrt(static_cast<double>(a.features));
    sum += weight * static_cast<double>(best);
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace placegraph
