#include <gtest/gtest.h>
#include <placegraph/io/synthetic/render/renderer.h>

#include <opencv2/core.hpp>

#include "tests/support/seed.h"

namespace placegraph::synthetic {
namespace rasterizer_test {

View small_view() {
  View view;
  view.camera.width = 160;
  view.camera.height = 120;
  view.camera.fx = view.camera.fy = 130;
  view.camera.cx = 79.3;
  view.camera.cy = 60.8;
  return view;
}

Face triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  Face face = make_quad(a, b - a, c - a, Material::kConcrete, SurfaceClass::kWall, 1);
  face.count = 3;
  face.corners = {a, b, c, c};
  face.two_sided = true;
  return face;
}

TEST(Rasterizer, TrianglesThatShareEdgesLeaveNoHole) {
  // A bumpy sheet of random triangles that fills the view, seen from random places.
  Random random = test::seeded_random(4);
  constexpr int kN = 24;
  std::vector<Eigen::Vector3d> grid;
  for (int j = 0; j <= kN; ++j) {
    for (int i = 0; i <= kN; ++i)
      grid.emplace_back(i - kN / 2 + random.uniform(-0.3, 0.3),
                        j - kN / 2 + random.uniform(-0.3, 0.3), 6 + random.uniform(-0.5, 0.5));
  }
  Scene scene;
  Part part;
  for (int j = 0; j < kN; ++j) {
    for (int i = 0; i < kN; ++i) {
      const Eigen::Vector3d *a = &grid[j * (kN + 1) + i], *b = a + kN + 1;
      part.faces.push_back(triangle(a[0], a[1], b[0]));
      part.faces.push_back(triangle(a[1], b[1], b[0]));
    }
  }
  part.finish();
  scene.parts.push_back(part);
  for (int round = 0; round < 5; ++round) {
    View view = small_view();
    view.T_scene_cam =
        SE3(SO3::exp({random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), round * 0.7}),
            Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), 0));
    const std::vector<SeenFace> faces = gather_faces(scene, view);
    SampleBand band(view.camera.width, view.camera.height);
    band.rasterize(faces, 0, view.camera.height);
    int holes = 0;
    for (int k = 0; k < SampleBand::kSamples; ++k) {
      for (int v = 0; v < view.camera.height; ++v) {
        for (int u = 0; u < view.camera.width; ++u) holes += band.face(k, v, u) < 0;
      }
    }
    EXPECT_EQ(holes, 0) << "round " << round;
  }
}

TEST(Rasterizer, KeepsTheNearerOfTwoFacesWhateverTheirOrder) {
  const Face near = triangle({-9, -9, 4}, {9, -9, 4}, {0, 30, 4}),
             far = triangle({-9, -9, 5}, {9, -9, 5}, {0, 30, 5});
  for (const bool near_first : {true, false}) {
    Scene scene;
    Part part;
    part.faces = near_first ? std::vector<Face>{near, far} : std::vector<Face>{far, near};
    part.finish();
    scene.parts = {part};
    const Rendering rendering = render(scene, small_view(), 1, false, 1);
    EXPECT_NEAR(depth_image(rendering).at<float>(60, 80), 4, 1e-5);
  }
}

TEST(Rasterizer, ClipsAFaceThatReachesBehindTheCamera) {
  Scene scene;
  Part part;
  // A floor 1.5 m below the camera, from 10 m behind it to 40 m ahead.
  part.faces.push_back(make_quad({-20, 1.5, -10}, {40, 0, 0}, {0, 0, 50}, Material::kConcrete,
                                 SurfaceClass::kFloor, 1));
  if (part.faces[0].normal[1] > 0) part.faces[0].normal = -part.faces[0].normal;
  part.finish();
  scene.parts = {part};
  const View view = small_view();
  const Image depth = depth_image(render(scene, view, 1, false, 1));
  for (const int v : {75, 90, 119}) {
    const double expected = 1.5 * view.camera.fy / (v - view.camera.cy);
    EXPECT_NEAR(depth.at<float>(v, 10), expected, 1e-5 * expected) << "row " << v;
  }
  EXPECT_EQ(depth.at<float>(40, 80), 0);  // sky
}

TEST(Renderer, EdgesLieWhereTheCameraProjectsThem) {
  // A bright board against darkness: the covered part of each row tells where its sides are.
  Scene scene;
  scene.outdoor = false;
  const Eigen::Vector3d a(-1.237, -0.871, 5.1), b(1.113, -0.871, 4.3);
  Part part;
  Face face = make_quad(a, b - a, {0, 1.9, 0}, Material::kConcrete, SurfaceClass::kWall, 1);
  face.two_sided = true;
  part.faces.push_back(face);
  part.finish();
  scene.parts = {part};
  const View view = small_view();
  const Rendering rendering = render(scene, view, 0, false, 1);  // contrast 0: uniform grey
  const auto left = view.camera.project(a), right = view.camera.project(b);
  ASSERT_TRUE(left && right);
  const int row = static_cast<int>(view.camera.cy);
  const float full = rendering.grey.at<float>(row, 80);
  double sum = 0, moment = 0;
  for (int u = 0; u < view.camera.width; ++u) {
    sum += rendering.grey.at<float>(row, u) / full;
    moment += u * rendering.grey.at<float>(row, u) / full;
  }
  // Five samples a pixel place each side to half their spacing of 0.25 px.
  EXPECT_NEAR(sum, (*right)[0] - (*left)[0], 0.25);
  EXPECT_NEAR(moment / sum, 0.5 * ((*right)[0] + (*left)[0]), 0.13);
}

TEST(Renderer, BitsDoNotDependOnTheNumberOfThreads) {
  Scene scene;
  Part part;
  add_box(part, {0.3, 1, 5}, {1, 0, 0}, {0, 0, 1}, {2, 2, 2}, Material::kMasonry, Material::kRoof,
          SurfaceClass::kBuilding, 3);
  part.finish();
  scene.parts = {part};
  const Rendering one = render(scene, small_view(), 1, true, 1),
                  four = render(scene, small_view(), 1, true, 4);
  EXPECT_EQ(cv::norm(one.grey, four.grey, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.inverse_depth, four.inverse_depth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.labels, four.labels, cv::NORM_INF), 0);
  EXPECT_GT(cv::countNonZero(one.labels), 0);
}

TEST(World, BoxesShowTheirOutsidesOnly) {
  Part part;
  const Eigen::Vector3d base(2, 1, 7), middle = base - Eigen::Vector3d(0, 1.5, 0);
  const double c = 0.8, s = 0.6;
  add_box(part, base, {c, 0, s}, {-s, 0, c}, {2, 3, 1}, Material::kMasonry, Material::kRoof,
          SurfaceClass::kBuilding, 3);
  ASSERT_EQ(part.faces.size(), 5U);
  for (const Face& face : part.faces) {
    EXPECT_GT(face.normal.dot(face.corners[0] - middle), 0);
    for (int i = 0; i < face.count; ++i)
      EXPECT_NEAR(face.normal.dot(face.corners[i] - face.corners[0]), 0, 1e-12);
  }
}

TEST(World, FootprintsOverlapOnlyIfTheyShareGround) {
  const Footprint a{{0, 0}, {1, 0}, 2, 1};
  const Footprint rotated{{3.2, 0}, Eigen::Vector2d(1, 1).normalized(), 1, 1};
  EXPECT_TRUE(a.overlaps(rotated));  // its corner reaches 1.41 m towards a
  Footprint off = rotated;
  off.centre[0] = 3.5;
  EXPECT_FALSE(a.overlaps(off));
  EXPECT_DOUBLE_EQ(a.distance({5, 5}), 5);  // 3 along, 4 across
  EXPECT_DOUBLE_EQ(a.distance({1, 0.5}), 0);
}

}  // namespace rasterizer_test
}  // namespace placegraph::synthetic
