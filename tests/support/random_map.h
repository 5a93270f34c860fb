#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/io/map/map_database.h>

namespace placegraph::test {

inline SE3 random_pose(Random& random) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = random.uniform(-2, 2);
  return SE3::exp(xi);
}

template <int N>
Eigen::Matrix<double, N, N> random_information(Random& random) {
  Eigen::Matrix<double, N, N> A;
  for (int i = 0; i < A.size(); ++i) A.data()[i] = random.normal();
  Eigen::Matrix<double, N, N> information = A * A.transpose();
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < i; ++j) information(i, j) = information(j, i);
  return information;
}

inline std::vector<Feature> random_features(Random& random, int count) {
  std::vector<Feature> features(static_cast<std::size_t>(count));
  for (Feature& feature : features) {
    feature.px = {static_cast<float>(random.uniform(0, 640)),
                  static_cast<float>(random.uniform(0, 480))};
    feature.angle_rad = static_cast<float>(random.uniform(-3, 3));
    feature.octave = random.index(8);
    for (auto& bits : feature.descriptor)
      bits = static_cast<std::uint64_t>(random.next()) << 32 | random.next();
    if (random.index(2) == 0)
      feature.point_cam = Eigen::Vector3f::Constant(static_cast<float>(random.uniform(1, 9)));
  }
  return features;
}

inline CueGrid random_grid(Random& random, int columns, int rows, int channels) {
  CueGrid grid{columns, rows, channels, {}, {}};
  for (int i = 0; i < columns * rows * channels; ++i)
    grid.values.push_back(static_cast<std::int16_t>(random.index(2000) - 1000));
  grid.energy = cell_energy(columns, rows, channels, grid.values);
  return grid;
}

inline PlaceView random_view(Random& random) {
  PlaceView view;
  view.tiny = {random_grid(random, 6, 4, 3)};
  view.gradients = {random_grid(random, 4, 3, 9)};
  view.colour = random_grid(random, 2, 2, 8);
  view.gabor = random_grid(random, 3, 2, 5);
  view.coarse = random_grid(random, 3, 2, 3);
  for (int i = 0; i < 12; ++i)
    view.thumbnail.push_back(static_cast<std::int16_t>(random.index(99)));
  view.corners = random_features(random, 5);
  for (Feature& corner : view.corners) corner.point_cam.reset();
  return view;
}

/// A map such as a run leaves behind, of random numbers: places with their keyframes, of one scale
/// or each of its own.
inline StoredMap random_map(Random& random, int places = 4, bool scaled = false) {
  StoredMap stored;
  stored.origin.sequence = "/data/somewhere";
  Calibration& calibration = stored.origin.calibration.emplace();
  calibration.camera = {640, 480, 500, 501, 320, 240, Distortion::kNone, {}};
  calibration.baseline_m = 0.5;
  stored.origin.options = "seed: 7\n";
  stored.origin.lens_k1 = random.normal();
  stored.history.median_depth_m = 4;
  stored.history.scale_measured = {true, !scaled};
  Map& map = stored.map;
  map.metric = !scaled;
  std::int64_t id = 0;
  for (int p = 0; p < places; ++p) {
    Place place{PlaceId(p),
                KeyframeId(id),
                random_pose(random),
                p == 3 ? 1 : 0,
                {},
                {},
                {},
                scaled ? random.uniform(0.5, 2) : 1};
    place.labels.assign(static_cast<std::size_t>(random.index(3)), "a 'kitchen'");
    for (std::uint32_t word = 0; word < 5; ++word)
      place.appearance.words.emplace_back(3 * word, static_cast<float>(random.uniform()));
    const KeyframeId anchor(id);
    for (int k = 0; k <= random.index(3); ++k, ++id) {
      Keyframe keyframe{KeyframeId(id),
                        FrameId(3 * id + 1),
                        1000 * id,
                        PlaceId(p),
                        k == 0 ? SE3() : random_pose(random),
                        random_features(random, random.index(20)),
                        1,
                        random_view(random)};
      for (int l = random.index(3); l < 2500; l += 300 + random.index(200))
        keyframe.observations.push_back({LandmarkId(l), Eigen::Vector2f::Random(), l % 2});
      keyframe.thumbnail = std::string("\xff\xd8") + std::string(static_cast<std::size_t>(k), 'x');
      place.members.push_back({KeyframeId(id), keyframe.T_place_keyframe, keyframe.scale});
      PlaceHistory::Keyframe link{KeyframeId(id), anchor, p == 3 ? 1 : 0, {}};
      if (k > 0 || (p > 0 && p != 3))
        link.link =
            KeyframeLink{KeyframeId(id - 1), random_pose(random), random_information<6>(random)};
      stored.history.keyframes.push_back(link);
      map.keyframes.push_back(std::move(keyframe));
    }
    PlaceHistory::Segment segment{
        anchor, PlaceId(p), Sim3(random_pose(random)), random_information<7>(random), {}};
    if (p % 2 == 1) segment.motion_covariance = random_information<6>(random);
    stored.history.segments.push_back(segment);
    stored.history.places.push_back({PlaceId(p), random.uniform(1, 2), KeyframeId(id - 1)});
    map.place_graph.places.push_back(std::move(place));
  }
  for (int p = 1; p < places; ++p) {
    RelativePoseConstraint edge;
    edge.from = NodeId(p - 1);
    edge.to = NodeId(p);
    edge.T_from_to = random_pose(random);
    edge.information = random_information<6>(random);
    if (scaled) {
      const SE3 T = random_pose(random);
      edge.T_from_to = Sim3(T.rotation(), T.translation(), random.uniform(0.5, 2));
      edge.information = random_information<7>(random);
    }
    if (p == 2) edge.source = ConstraintSource::kLoop;
    edge.kernel = {RobustKernel::Kind::kCauchy, 3};
    map.place_graph.constraints.push_back(edge);
  }
  for (std::int64_t f = 0; f < 3 * id; ++f) {
    FrameRecord record{FrameId(f), 100 * f, KeyframeId(f / 3), random_pose(random),
                       static_cast<int>(17 * f)};
    record.confidence = random.uniform();
    if (f % 7 == 5) {
      record = {FrameId(f), 100 * f, std::nullopt, std::nullopt, 0};
      record.reason = "only 'few' points";
    }
    map.frames.push_back(record);
    StampedPose& online = map.trajectory_online.poses.emplace_back();
    online.stamp_ns = 100 * f;
    if (record.T_keyframe_frame) online.T_world_body = random_pose(random).isometry();
  }
  for (int l = 0; l < 2500; ++l) {
    PointLandmark& landmark = map.landmarks.emplace_back();
    landmark = {LandmarkId(l), KeyframeId(random.index(static_cast<int>(id))),
                Eigen::Vector3d::Random(), random.index(9)};
    if (l % 3 > 0) landmark.rgb = {static_cast<std::uint8_t>(l % 256), 7, 255};
    if (l % 5 > 0) landmark.covariance = random_information<3>(random).cast<float>().cast<double>();
  }
  map.loops.push_back({FrameId(9), FrameId(1), 33, LoopStage::kAccepted, random_pose(random),
                       LoopModel::kPoints3d2d, 4, 0.7, 0.9});
  map.loops.push_back({FrameId(10), FrameId(2), 0, LoopStage::kGeometry, {}});
  stored.history.loops.push_back(
      {KeyframeId(id - 1), KeyframeId(0), random_pose(random), random_information<7>(random), 1});
  stored.history.founded = places + 2;
  stored.history.judged_loops = 1;
  stored.history.merged.push_back(
      {KeyframeId(0), {{KeyframeId(0), random_information<7>(random)}}});
  stored.history.separated.insert({KeyframeId(0), KeyframeId(id - 1)});
  if (places > 1)
    stored.history.motions.push_back({KeyframeId(0), stored.history.segments[1].anchor,
                                      random_pose(random), random_information<6>(random)});
  Judgement& judgement = stored.judgement.emplace();
  judgement.verdict = Verdict::kDoubtful;
  judgement.why_metric = "by the baseline";
  judgement.metric = map.metric;
  if (map.metric) judgement.expected_drift_m = random.uniform();
  judgement.findings.push_back(
      {"the 'lens' is \xc3\xa4", true, NoteCause::kDistortion, "measure it"});
  judgement.findings.push_back({"a jump", false, NoteCause::kJump});
  stored.history.evidence = std::string("what\0is known", 13);
  Image mask(6, 8, CV_8UC1, cv::Scalar(255));
  mask.at<std::uint8_t>(random.index(6), random.index(8)) = 0;
  stored.origin.overlays.push_back({mask, {"dirt", false, NoteCause::kStaticOverlay, "wipe it"}});
  stored.run.notes.push_back({"'late'", true, NoteCause::kRightImageLate, "trigger it"});
  stored.run.odometry_error = {random_information<6>(random), random_information<6>(random)};
  stored.run.stages = {{"reading", random.uniform(), 3}, {"window", random.uniform(), 0}};
  return stored;
}

}  // namespace placegraph::test
