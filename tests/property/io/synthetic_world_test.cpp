#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/io/synthetic/worlds/tours.h>
#include <placegraph/io/synthetic/worlds/town_builder.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "tests/support/data.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace synthetic_world_test {

using synthetic::Difficulty;
using synthetic::Face;
using synthetic::Material;
using synthetic::Part;
using synthetic::Rendering;
using synthetic::SurfaceClass;
using synthetic::Tour;
using synthetic::View;

constexpr int kWidth = 248, kHeight = 75;
constexpr double kClear_m = 1.5;  // of every solid's ground plan from the camera, outdoors

SyntheticWorld open(const std::string& name, Difficulty difficulty = Difficulty::kClean) {
  SyntheticOptions options;
  options.world = name;
  options.difficulty = difficulty;
  options.width = kWidth;
  options.height = kHeight;
  return SyntheticWorld(options);
}

View view_of(const Tour& tour, std::size_t index, double right_m = 0) {
  View view{tour.camera, tour.T_scene_cam[index], tour.time_s[index]};
  view.T_scene_cam = view.T_scene_cam * SE3(SO3(), Eigen::Vector3d(right_m, 0, 0));
  return view;
}

/// Bilinear inverse depth, if the four pixels around lie on one smooth piece.
std::optional<double> inverse_depth_at(const Image& iz, const Eigen::Vector2d& px) {
  const int u = static_cast<int>(px[0]), v = static_cast<int>(px[1]);
  const double fu = px[0] - u, fv = px[1] - v;
  const double a = iz.at<float>(v, u), b = iz.at<float>(v, u + 1), c = iz.at<float>(v + 1, u),
               d = iz.at<float>(v + 1, u + 1);
  // On a plane inverse depth is affine in the pixel.
  if (std::abs(a + d - b - c) > 1e-6 || std::min({a, b, c, d}) <= 0) return std::nullopt;
  return (1 - fv) * ((1 - fu) * a + fu * b) + fv * ((1 - fu) * c + fu * d);
}

/// Whether the pixel and its four neighbours see one plane.
bool on_one_plane(const Image& iz, int u, int v) {
  if (u < 1 || v < 1 || u + 1 >= iz.cols || v + 1 >= iz.rows) return false;
  const float c = iz.at<float>(v, u);
  return c > 0 && std::abs(iz.at<float>(v, u - 1) + iz.at<float>(v, u + 1) - 2 * c) < 1e-6F &&
         std::abs(iz.at<float>(v - 1, u) + iz.at<float>(v + 1, u) - 2 * c) < 1e-6F;
}

/// Carries every pixel of one view into another through depth and poses and compares with what is
/// rendered there. Returns the share of comparable pixels whose depth agrees to 1e-4.
double agreement(const Tour& tour, const View& from, const View& to) {
  const Rendering here = synthetic::render(tour.scene, from, 1, false, 1),
                  there = synthetic::render(tour.scene, to, 1, false, 1);
  const Image depth = synthetic::depth_image(here);
  const SE3 T_to_from = to.T_scene_cam.inverse() * from.T_scene_cam;
  int agreed = 0, compared = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      if (!on_one_plane(here.inverse_depth, u, v)) continue;
      const Eigen::Vector3d p =
          T_to_from * (depth.at<float>(v, u) * *from.camera.unproject({u, v}));
      const auto px = to.camera.project(p);
      if (!px || !to.camera.contains(*px, 1)) continue;
      const auto iz = inverse_depth_at(there.inverse_depth, *px);
      if (!iz || *iz > 1 / p[2] * 1.002) continue;  // an edge, or hidden behind something nearer
      ++compared;
      agreed += std::abs(*iz * p[2] - 1) < 1e-4;
    }
  }
  EXPECT_GT(compared, kWidth * kHeight / 8);
  return 1.0 * agreed / compared;
}

class World : public ::testing::TestWithParam<const char*> {};

TEST_P(World, DepthAndPosesCarryPixelsOntoEqualDepthInOtherFrames) {
  const SyntheticWorld world = open(GetParam());
  Random random = test::seeded_random(5);
  for (int i = 0; i < 4; ++i) {
    const auto from = static_cast<std::size_t>(random.index(static_cast<int>(world.size()) - 5));
    // The rest are planes of few pixels, seen past by one of the two.
    EXPECT_GT(agreement(world.tour(), view_of(world.tour(), from), view_of(world.tour(), from + 2)),
              0.99)
        << "frame " << from;
  }
}

TEST_P(World, RightCameraSeesEachPointBaselineTimesFocalLengthOverDepthFurtherLeft) {
  const SyntheticWorld world = open(GetParam());
  const Tour& tour = world.tour();
  const std::size_t at = world.size() / 3;
  const View left = view_of(tour, at), right = view_of(tour, at, tour.baseline_m);
  EXPECT_GT(agreement(tour, left, right), 0.99);
  // The images agree with it: grey values at u and u - f b / z.
  const SyntheticContents contents{true, true, false, false, false};
  const SyntheticFrame frame = world.render(at, contents);
  std::vector<double> differences;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 40; u < kWidth - 1; ++u) {
      const float z = frame.frame.depth.at<float>(v, u);
      if (z <= 0) continue;
      const double disparity = tour.camera.fx * tour.baseline_m / z, x = u - disparity;
      const int ix = static_cast<int>(std::floor(x));
      if (ix < 0) continue;
      const auto* row = frame.frame.right.ptr<unsigned char>(v);
      const double grey = row[ix] + (x - ix) * (row[ix + 1] - row[ix]);
      differences.push_back(std::abs(grey - frame.frame.image.at<unsigned char>(v, u)));
    }
  }
  std::nth_element(differences.begin(), differences.begin() + differences.size() / 2,
                   differences.end());
  EXPECT_LT(differences[differences.size() / 2], 6);  // bilinear interpolation of fine texture
}

TEST_P(World, FlowOfStaticPixelsFollowsFromDepthAndPoses) {
  const SyntheticWorld world = open(GetParam());
  SyntheticContents contents;
  contents.depth = contents.flow = true;
  const std::size_t at = world.size() / 2;
  const SyntheticFrame frame = world.render(at, contents);
  const Camera camera = world.calibration().camera;
  const Trajectory truth = world.ground_truth();
  const SE3 T_next_cur =
      SE3(*truth.poses[at + 1].T_world_body).inverse() * SE3(*truth.poses[at].T_world_body);
  double worst = 0;
  int compared = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const float z = frame.frame.depth.at<float>(v, u);
      const cv::Vec2f flow = frame.flow.at<cv::Vec2f>(v, u);
      if (z <= 0 || std::isnan(flow[0])) continue;
      const auto px = camera.project(T_next_cur * (z * *camera.unproject({u, v})));
      ASSERT_TRUE(px);
      if ((*px - Eigen::Vector2d(u, v)).norm() > 100) continue;  // float's digits end
      worst = std::max(worst, (*px - Eigen::Vector2d(u + flow[0], v + flow[1])).norm());
      ++compared;
    }
  }
  EXPECT_GT(compared, kWidth * kHeight / 4);
  EXPECT_LT(worst, 1e-3);
}

TEST_P(World, BitsDoNotDependOnTheNumberOfThreads) {
  SyntheticOptions options;
  options.world = GetParam();
  options.width = kWidth;
  options.height = kHeight;
  const SyntheticContents all{true, true, true, true, true};
  const SyntheticFrame one = SyntheticWorld(options).render(77, all);
  options.threads = 2;
  const SyntheticFrame two = SyntheticWorld(options).render(77, all);
  EXPECT_EQ(cv::norm(one.frame.image, two.frame.image, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.frame.right, two.frame.right, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.frame.depth, two.frame.depth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.labels, two.labels, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.planes, two.planes, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(one.flow, two.flow, cv::NORM_INF), 0);
}

TEST_P(World, PlanePixelsLieOnTheirPlane) {
  const SyntheticWorld world = open(GetParam());
  SyntheticContents contents;
  contents.depth = contents.planes = true;
  const std::vector<Eigen::Vector4d> planes = world.planes();
  const std::size_t at = world.size() / 4;
  const SyntheticFrame frame = world.render(at, contents);
  const Eigen::Isometry3d T_world_cam = *world.ground_truth().poses[at].T_world_body;
  int listed = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const int id = frame.planes.at<unsigned short>(v, u);
      if (id == 0) continue;
      ++listed;
      const double z = frame.frame.depth.at<float>(v, u);
      const Eigen::Vector3d p = T_world_cam * (z * *world.calibration().camera.unproject({u, v}));
      ASSERT_LT(std::abs(planes[id].head<3>().dot(p) - planes[id][3]), 1e-6 * z + 1e-5);
    }
  }
  EXPECT_GT(listed, kWidth * kHeight / 20);
}

/// The height of the ground faces below a point: y of the lowest-lying hit among the road's.
std::optional<double> ground_below(const Tour& tour, const Eigen::Vector3d& p) {
  for (const Part& part : tour.scene.parts) {
    if ((part.centre - p).norm() > part.radius + 3) continue;
    for (const Face& face : part.faces) {
      if (face.label != SurfaceClass::kRoad && face.label != SurfaceClass::kFloor) continue;
      if (face.material == Material::kShadow) continue;
      bool inside = true;
      double sign = 0;
      for (int i = 0; i < face.count && inside; ++i) {
        const Eigen::Vector3d &a = face.corners[i], &b = face.corners[(i + 1) % face.count];
        const double side = (b[0] - a[0]) * (p[2] - a[2]) - (b[2] - a[2]) * (p[0] - a[0]);
        if (std::abs(side) < 1e-9) continue;
        inside = sign == 0 || side * sign > 0;
        sign = side;
      }
      if (!inside) continue;
      const double d = face.normal.dot(face.corners[0]);
      return (d - face.normal[0] * p[0] - face.normal[2] * p[2]) / face.normal[1];
    }
  }
  return std::nullopt;
}

void expect_camera_height(const Tour& tour, double tolerance_m) {
  for (std::size_t i = 0; i < tour.T_scene_cam.size(); i += 7) {
    const Eigen::Vector3d p = tour.T_scene_cam[i].translation();
    const auto ground = ground_below(tour, p);
    ASSERT_TRUE(ground) << "no ground below frame " << i;
    ASSERT_NEAR(*ground - p[1], tour.camera_height_m, tolerance_m) << "frame " << i;
  }
}

/// Distance from a point to a segment, both seen from above.
double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  const double s = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0;
  return (a + s * d - p).norm();
}

/// Nothing that is rendered as a solid comes closer to any camera position than `clear_m` within
/// the vehicle's height: judged by the faces themselves, not by the footprints they were placed by.
void expect_free_path(const Tour& tour, double clear_m, double footprint_clear_m) {
  for (const auto& solid : tour.scene.solids) {
    for (const SE3& T : tour.T_scene_cam)
      ASSERT_GT(solid.distance({T.translation()[0], T.translation()[2]}), footprint_clear_m);
  }
  for (const Part& part : tour.scene.parts) {
    std::vector<Eigen::Vector3d> near;
    for (const SE3& T : tour.T_scene_cam) {
      const Eigen::Vector3d p = T.translation();
      if (std::hypot(p[0] - part.centre[0], p[2] - part.centre[2]) < part.radius + 2)
        near.push_back(p);
    }
    for (const Face& face : part.faces) {
      const SurfaceClass label = face.label;
      if (label == SurfaceClass::kRoad || label == SurfaceClass::kPavement ||
          label == SurfaceClass::kTerrain || label == SurfaceClass::kKerb ||
          label == SurfaceClass::kFloor || label == SurfaceClass::kCeiling)
        continue;
      double lowest = -1e9;
      for (int i = 0; i < face.count; ++i) lowest = std::max(lowest, face.corners[i][1]);
      for (const Eigen::Vector3d& p : near) {
        if (lowest < p[1] - 0.4) continue;  // ends above the vehicle's roof
        for (int i = 0; i < face.count; ++i) {
          const Eigen::Vector3d &a = face.corners[i], &b = face.corners[(i + 1) % face.count];
          ASSERT_GT(distance({p[0], p[2]}, {a[0], a[2]}, {b[0], b[2]}), clear_m)
              << to_string(label) << " at " << a.transpose();
        }
      }
    }
  }
}

TEST_P(World, CameraKeepsItsHeightAboveTheRenderedGround) {
  expect_camera_height(open(GetParam()).tour(), 0.001);
}

TEST_P(World, NothingSolidStandsOnThePath) {
  const SyntheticWorld world = open(GetParam());
  const double half_m = world.is_indoor() ? 0.3 : synthetic::kCarHalfWidth_m;
  expect_free_path(world.tour(), half_m, world.is_indoor() ? half_m : kClear_m);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, World,
                         ::testing::Values("town-loop", "repeated-blocks", "corridor-loop",
                                           "warehouse"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// Frames that lie within 5 m and 30 degrees of a pose at least 300 frames older.
std::vector<bool> revisits(const Tour& tour) {
  std::vector<bool> out(tour.T_scene_cam.size(), false);
  for (std::size_t i = 300; i < out.size(); ++i) {
    for (std::size_t j = 0; j + 300 <= i && !out[i]; ++j) {
      const SE3 &a = tour.T_scene_cam[i], &b = tour.T_scene_cam[j];
      const double angle = (a.rotation().inverse() * b.rotation()).log().norm();
      out[i] = (a.translation() - b.translation()).norm() < 5 && angle < deg_to_rad(30);
    }
  }
  return out;
}

TEST(TownLoop, IsLongEnoughAndComesBackTwice) {
  const SyntheticWorld world = open("town-loop");
  EXPECT_GE(world.size(), 600U);
  double length_m = 0, fastest = 0;
  const auto& poses = world.tour().T_scene_cam;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double step = (poses[i].translation() - poses[i - 1].translation()).norm();
    length_m += step;
    fastest = std::max(fastest, step * 10);
  }
  EXPECT_GE(length_m, 600);
  EXPECT_LT(fastest, 10.5);
  const std::vector<bool> again = revisits(world.tour());
  int stretches = 0, run = 0;
  for (const bool hit : again) {
    run = hit ? run + 1 : 0;
    stretches += run == 20;  // two seconds of it
  }
  EXPECT_GE(stretches, 2);
}

TEST(TownLoop, NodsLikeACarFromItsFirstFrameToItsLast) {
  const SyntheticWorld world = open("town-loop");
  const auto& poses = world.tour().T_scene_cam;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Vector3d step_rotation =
        (poses[i - 1].rotation().inverse() * poses[i].rotation()).log();
    EXPECT_LT(std::abs(step_rotation.x()), deg_to_rad(0.5)) << "frame " << i;
  }
}

TEST(TownLoop, MovingCarsAreFollowedByFlowAndKeepTheirDistance) {
  const SyntheticWorld world = open("town-loop", Difficulty::kStandard);
  const Tour& tour = world.tour();
  ASSERT_FALSE(tour.scene.movers.empty());
  EXPECT_TRUE(open("town-loop", Difficulty::kClean).tour().scene.movers.empty());
  int checked = 0;
  for (std::size_t i = 10; i + 1 < tour.T_scene_cam.size() && checked < 3; i += 23) {
    const View view = view_of(tour, i), next = view_of(tour, i + 1);
    const Rendering rendering = synthetic::render(tour.scene, view, 1, true, 1);
    if (cv::countNonZero(rendering.mover >= 0) < 40) continue;
    const Image depth = synthetic::depth_image(rendering),
                flow = synthetic::flow_image(tour.scene, rendering, view, next);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const int mover = rendering.mover.at<short>(v, u);
        if (mover < 0) continue;
        const auto now = tour.scene.movers[mover].T_scene_object(view.time_s),
                   then = tour.scene.movers[mover].T_scene_object(next.time_s);
        ASSERT_TRUE(now);
        if (!then) continue;
        // The point is fixed on the car.
        const Eigen::Vector3d on_car =
            now->inverse() *
            (view.T_scene_cam * (depth.at<float>(v, u) * *view.camera.unproject({u, v})));
        const auto px = next.camera.project(next.T_scene_cam.inverse() * (*then * on_car));
        ASSERT_TRUE(px);
        const cv::Vec2f f = flow.at<cv::Vec2f>(v, u);
        ASSERT_LT((*px - Eigen::Vector2d(u + f[0], v + f[1])).norm(), 1e-3);
      }
    }
    ++checked;
  }
  EXPECT_EQ(checked, 3);
}

TEST(KittiDrive, Sequence06IsRenderedOnItsOwnPathWithRealLoops) {
  PLACEGRAPH_DATA_OR_SKIP(poses, "kitti_gt/06/poses.txt");
  const SyntheticWorld world = open(poses);
  ASSERT_EQ(world.size(), 1101U);
  const Tour& tour = world.tour();
  expect_camera_height(tour, 0.001);
  expect_free_path(tour, synthetic::kCarHalfWidth_m, kClear_m);
  const std::vector<bool> again = revisits(tour);
  EXPECT_GT(std::count(again.begin(), again.end(), true), 200);
  const SyntheticContents contents{true, true, true, false, false};
  for (const std::size_t i : {std::size_t{0}, world.size() - 1}) {
    const SyntheticFrame frame = world.render(i, contents);
    cv::Scalar mean, sigma;
    cv::meanStdDev(frame.frame.image, mean, sigma);
    EXPECT_GT(sigma[0], 25);
    const double road = cv::countNonZero(frame.labels == static_cast<int>(SurfaceClass::kRoad));
    EXPECT_GT(road, 0.1 * kWidth * kHeight);
  }
}

TEST(KittiDrive, PitchAndRollAgainstTheFittedRoadStaySmallOnHillyDrives) {
  for (const char* name : {"02", "08", "09"}) {
    PLACEGRAPH_DATA_OR_SKIP(poses, std::string("kitti_gt/") + name + "/poses.txt");
    const SyntheticWorld world = open(poses);
    std::vector<double> tilts;
    for (std::size_t i = 4; i + 4 < world.size(); i += 5) {
      const SE3& T = world.tour().T_scene_cam[i];
      const Eigen::Vector3d step = world.tour().T_scene_cam[i + 4].translation() -
                                   world.tour().T_scene_cam[i - 4].translation();
      if (step.norm() < 2) continue;
      tilts.push_back(std::abs(T.rotation().matrix().col(1).dot(step.normalized())));
    }
    ASSERT_FALSE(tilts.empty());
    std::sort(tilts.begin(), tilts.end());
    // The direction of travel along the ground against the camera's horizontal plane.
    EXPECT_LT(tilts[tilts.size() / 2], 0.03) << name;  // 02, 09: the mounting itself, over 1 deg
    EXPECT_LT(tilts[tilts.size() * 99 / 100], 0.06) << name;
  }
}

}  // namespace synthetic_world_test
}  // namespace placegraph
