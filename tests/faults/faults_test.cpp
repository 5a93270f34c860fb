// What holds for every fault of the table.
#include <set>

#include "tests/faults/small_recording.h"

namespace placegraph::faults::test {
namespace faults_test {

bool equal_frames(const Recording& a, const Recording& b, std::size_t index) {
  const Frame &f = a.frames[index], &g = b.frames[index];
  return f.stamp_ns == g.stamp_ns && equal(f.image, g.image) && equal(f.right, g.right) &&
         equal(f.depth, g.depth) && a.T_world_cam[index].isApprox(b.T_world_cam[index], 1e-12);
}

bool equal_recordings(const Recording& a, const Recording& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!equal_frames(a, b, i)) return false;
  const Camera &c = a.calibration.camera, &d = b.calibration.camera;
  return c.fx == d.fx && c.fy == d.fy && c.cx == d.cx && c.cy == d.cy &&
         a.calibration.baseline_m == b.calibration.baseline_m &&
         a.calibration.camera_height_m == b.calibration.camera_height_m &&
         a.stated_depth_unit_m == b.stated_depth_unit_m;
}

TEST(Faults, TableHasSixtyAndNamesAreUnique) {
  std::set<std::string> names;
  for (const Fault& fault : all_faults()) names.insert(fault.name);
  EXPECT_EQ(names.size(), all_faults().size());
  EXPECT_GE(names.size(), 60U);
}

TEST(Faults, EveryFaultChangesTheRecordingAndNotItsArgument) {
  const Recording recording = small_recording(), copy = small_recording();
  for (const Fault& fault : all_faults()) {
    SCOPED_TRACE(fault.name);
    const Recording out = fault.apply(recording, 1);
    EXPECT_FALSE(equal_recordings(out, recording));
    EXPECT_TRUE(equal_recordings(recording, copy));
  }
}

TEST(Faults, EveryFaultIsTheSameForTheSameSeed) {
  const Recording recording = small_recording();
  for (const Fault& fault : all_faults()) {
    SCOPED_TRACE(fault.name);
    EXPECT_TRUE(equal_recordings(fault.apply(recording, 3), fault.apply(recording, 3)));
  }
}

TEST(Faults, FramesBeforeTheFaultyOnesAreUntouched) {
  const Recording recording = small_recording();
  for (const Fault& fault : all_faults()) {
    SCOPED_TRACE(fault.name);
    const Recording out = fault.apply(recording, 1);
    ASSERT_LE(out.faulty.first, out.faulty.last);
    ASSERT_LT(out.faulty.last, out.size());
    ASSERT_EQ(out.T_world_cam.size(), out.size());
    for (std::size_t i = 0; i < out.faulty.first; ++i)
      EXPECT_TRUE(equal_frames(out, recording, i)) << i;
  }
}

TEST(Faults, EveryFaultOfASensorWorksWithTheImagesOfThatSensorAlone) {
  Recording mono = small_recording();
  for (Frame& frame : mono.frames) frame.right = frame.depth = Image();
  mono.calibration.depth.reset();
  mono.T_world_cam.clear();
  for (const Fault& fault : all_faults()) {
    if (fault.sensors.find("mono") == std::string::npos) continue;
    SCOPED_TRACE(fault.name);
    EXPECT_NO_THROW(fault.apply(mono, 1));
  }
}

TEST(Faults, GroupsAlternate) {
  EXPECT_EQ(group_of(0), "fixed");
  EXPECT_EQ(group_of(1), "held");
  EXPECT_EQ(group_of(2), "fixed");
}

}  // namespace faults_test
}  // namespace placegraph::faults::test
