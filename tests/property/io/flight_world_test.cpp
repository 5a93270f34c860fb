#include <gtest/gtest.h>
#include <placegraph/io/synthetic/worlds/flight_world.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include <cmath>

namespace placegraph {
namespace flight_world_test {

using Eigen::Vector2d;
using Eigen::Vector3d;
using synthetic::FlightSetting;
using synthetic::Glyph;

SyntheticWorld flight_world(std::uint64_t seed, double duration_s) {
  SyntheticOptions options;
  options.world = "flight";
  options.difficulty = synthetic::Difficulty::kClean;
  options.seed = seed;
  options.duration_s = duration_s;
  return SyntheticWorld(options);
}

SE3 T_world_cam(const SyntheticWorld& world, std::size_t index) {
  const FlightSetting& setting = *world.flight_setting();
  return setting.flight.at_image(index).T_world_body * setting.T_body_cam;
}

/// Whether an image shows any marker whole, or any beacon.
bool sees_marks(const SyntheticWorld& world, std::size_t index) {
  const Camera camera = world.calibration().camera;
  const SE3 T_cam_world = T_world_cam(world, index).inverse();
  const auto in_view = [&](const Vector3d& p) {
    const auto px = camera.project(T_cam_world * p);
    return px && camera.contains(*px);
  };
  for (const Vector3d& beacon : world.flight_setting()->layout.beacons_world)
    if (in_view(beacon)) return true;
  for (const PlacedMarker& marker : world.flight_setting()->layout.markers) {
    bool whole = true;
    for (const Vector3d& corner : marker.corners_marker())
      whole = whole && in_view(marker.T_world_marker * corner);
    if (whole) return true;
  }
  return false;
}

TEST(FlightWorld, ShowsEveryCellOfItsMarkersWhereTheLayoutSaysIt) {
  const SyntheticWorld world = flight_world(2, 3);
  const Camera camera = world.calibration().camera;
  const Image image = world.render(0, {}).frame.image;
  const SE3 T_cam_world = T_world_cam(world, 0).inverse();
  int cells = 0;
  for (std::size_t m = 0; m < world.flight_setting()->layout.markers.size(); ++m) {
    const PlacedMarker& marker = world.flight_setting()->layout.markers[m];
    const Glyph& glyph = world.tour().scene.glyphs[m];
    for (int row = 0; row < glyph.cells; ++row)
      for (int column = 0; column < glyph.cells; ++column) {
        const double cell = marker.side_m / glyph.cells;
        const Vector3d middle(-0.5 * marker.side_m + (column + 0.5) * cell,
                              0.5 * marker.side_m - (row + 0.5) * cell, 0);
        const auto px = camera.project(T_cam_world * (marker.T_world_marker * middle));
        if (!px || !camera.contains(*px)) continue;
        const int u = static_cast<int>(std::lround(px->x())),
                  v = static_cast<int>(std::lround(px->y()));
        const bool white = glyph.white[static_cast<std::size_t>(row * glyph.cells + column)];
        EXPECT_EQ(image.at<unsigned char>(v, u) > 128, white) << m << " " << row << " " << column;
        ++cells;
      }
  }
  EXPECT_GT(cells, 100);
}

TEST(FlightWorld, LosesItsMarkersForFiveSecondsAgainAndAgain) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const SyntheticWorld world = flight_world(seed, 120);
    int outages = 0, blind = 0;
    double longest_s = 0;
    for (std::size_t i = 0; i < world.size(); ++i) {
      blind = sees_marks(world, i) ? 0 : blind + 1;
      outages += blind == 100;
      longest_s = std::max(longest_s, 0.05 * blind);
    }
    EXPECT_GE(outages, 5) << "seed " << seed;
    EXPECT_LT(longest_s, 12) << "seed " << seed;
    EXPECT_TRUE(sees_marks(world, 0)) << "seed " << seed;
  }
}

TEST(FlightWorld, StaysInTheAirAndOverItsFloor) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    synthetic::SimulatedFlightOptions options;
    options.seed = seed;
    for (const BodyState& state : synthetic::simulate_flight(options).truth) {
      const Vector3d& p = state.T_world_body.translation();
      ASSERT_GT(p.z(), 0.7) << "seed " << seed;
      ASSERT_LT(p.z(), 2.5) << "seed " << seed;
      ASSERT_LT(p.head<2>().norm(), 5.5) << "seed " << seed;
      ASSERT_LT(state.velocity_world.norm(), 3.0) << "seed " << seed;
    }
  }
}

TEST(FlightWorld, FlowLeadsToWhereTheFloorIsInTheNextImage) {
  const SyntheticWorld world = flight_world(5, 6);
  const Camera camera = world.calibration().camera;
  SyntheticContents contents;
  contents.flow = true;
  const std::size_t at = 100;
  const Image flow = world.render(at, contents).flow;
  const SE3 T_world_1 = T_world_cam(world, at), T_2_world = T_world_cam(world, at + 1).inverse();
  // All but the points on papers, which lie two millimetres above the floor.
  int exact = 0;
  for (int v = 7; v < camera.height; v += 40)
    for (int u = 5; u < camera.width; u += 40) {
      const Vector3d ray = T_world_1.rotation() * Vector3d(*camera.unproject({u, v}));
      const Vector3d floor = T_world_1.translation() - T_world_1.translation().z() / ray.z() * ray;
      const auto px = camera.project(T_2_world * floor);
      const cv::Vec2f d = flow.at<cv::Vec2f>(v, u);
      exact += px && (*px - Vector2d(u + d[0], v + d[1])).norm() < 1e-3;
    }
  EXPECT_GT(exact, 170);  // of 192
}

}  // namespace flight_world_test
}  // namespace placegraph
