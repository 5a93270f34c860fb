#include <gtest/gtest.h>
#include <placegraph/backend/inertial/error_state_filter.h>
#include <placegraph/frontend/align/plane_tracker.h>
#include <placegraph/frontend/features/detector.h>
#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/frontend/lines/line_stereo.h>
#include <placegraph/frontend/lines/line_tracker.h>
#include <placegraph/frontend/lines/pose_from_lines.h>
#include <placegraph/frontend/markers/marker_filter.h>
#include <placegraph/frontend/places/classifiers/place_classifier.h>
#include <placegraph/frontend/places/code_database.h>
#include <placegraph/frontend/places/place_database.h>
#include <placegraph/frontend/places/verification/loop_verifier.h>
#include <placegraph/frontend/planes/dominant_surface.h>
#include <placegraph/frontend/planes/ground_plane.h>
#include <placegraph/frontend/planes/motion_from_planes.h>
#include <placegraph/frontend/relative_pose/mono_initializer.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/frontend/relative_pose/relative_pose.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/segments/segment_matcher.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/graph/core/error.h>

#include <set>

namespace placegraph {
namespace options_test {

template <class Options>
class FrontendOptions : public testing::Test {};
using All = testing::Types<
    DetectorOptions, MatcherOptions, StereoMatcherOptions, PointTrackerOptions,
    MonoInitializerOptions, Pose2d2dOptions, Pose3d2dOptions, LoopVerifierOptions,
    PlaceDatabaseOptions, VocabularyOptions, GroundPlaneOptions, AlignOptions, PlanarRegionsOptions,
    MotionFromPlanesOptions, SegmentDetectorOptions, SegmentMatcherOptions, SceneDirectionOptions,
    PlaneTrackerOptions, GravityPoseOptions, RelativePoseOptions, CircularMotionOptions,
    Pose3d3dOptions, InverseDepthPlaneOptions, DominantSurfaceOptions, LineTrackerOptions,
    LineStereoOptions, LineTriangulationOptions, PoseFromLinesOptions, ErrorStateFilterOptions,
    SquareFitOptions, MarkerDetectorOptions, MarkerFilterOptions, BeaconDetectorOptions,
    BeaconPoseOptions, PlaceCodeOptions, PlaceClassifierOptions>;
TYPED_TEST_SUITE(FrontendOptions, All);

/// Puts the n-th number among the fields far below its range.
class Breaker : public OptionVisitor {
 public:
  explicit Breaker(int n) : left_(n) {}
  void operator()(const char*, bool&, const char*) override {}
  void operator()(const char*, int& value, const char*, Range range) override { set(value, range); }
  void operator()(const char*, std::uint64_t&, const char*) override {}
  void operator()(const char*, double& value, const char*, Range range) override {
    set(value, range);
  }
  void operator()(const char*, std::string&, const char*) override {}
  void operator()(const char*, std::vector<double>&, const char*, Range) override {}
  bool done() const { return left_ < 0; }

 protected:
  void choice_index(const char*, int&, const std::vector<std::string>&, const char*) override {}
  void begin_group(const char*, const char*) override {}
  void end_group() override {}

 private:
  template <class T>
  void set(T& value, Range range) {
    if (left_-- == 0) value = static_cast<T>(range.min - 1);
  }
  int left_;
};

TYPED_TEST(FrontendOptions, HaveSoundDefaultsAndEveryNumberHasARange) {
  const TypeParam defaults;
  EXPECT_NO_THROW(defaults.check());
  std::set<std::string> paths;
  for (const OptionEntry& entry : list_options(defaults)) {
    EXPECT_TRUE(paths.insert(entry.path).second) << entry.path;
    EXPECT_FALSE(entry.doc.empty()) << entry.path;
  }
  int broken = 0;
  for (;; ++broken) {
    TypeParam options;
    Breaker breaker(broken);
    visit(breaker, options);
    if (!breaker.done()) break;
    EXPECT_THROW(options.check(), ArgumentError) << "number " << broken;
  }
  EXPECT_GT(broken, 0);
}

}  // namespace options_test
}  // namespace placegraph
