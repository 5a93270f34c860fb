#include "python/src/eval/evaluation_tables.h"

#include <placegraph/graph/core/error.h>

#include <limits>

namespace placegraph::python {

Table frame_table(const EvaluationResult& result) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::int64_t> frame, stamp;
  std::vector<double> truth, estimate, error, rotation, along, across, up;
  std::size_t next = 0;
  const auto of_frame = [&](const auto& values, std::size_t i) {
    return i < values.size() ? values[i] : kUnknown;
  };
  for (const FramePair& pair : result.aligned_pairs) {
    frame.push_back(pair.frame);
    stamp.push_back(pair.stamp_ns);
    append_rows(pair.T_world_truth.matrix(), truth);
    append_rows(pair.T_world_estimate ? Eigen::Matrix4d(pair.T_world_estimate->matrix())
                                      : Eigen::Matrix4d::Constant(kUnknown),
                estimate);
    const std::size_t posed =
        pair.T_world_estimate ? next++ : std::numeric_limits<std::size_t>::max();
    error.push_back(of_frame(result.ape.frame_errors_m, posed));
    rotation.push_back(of_frame(result.ape.frame_errors_deg, posed));
    const std::vector<Eigen::Vector3d>& parts = result.components.errors_m;
    along.push_back(posed < parts.size() ? parts[posed][0] : kUnknown);
    across.push_back(posed < parts.size() ? parts[posed][1] : kUnknown);
    up.push_back(posed < parts.size() ? parts[posed][2] : kUnknown);
  }
  const std::size_t n = frame.size();
  std::vector<double> travelled = result.travelled_m;
  travelled.resize(n, kUnknown);
  Table table;
  table["frame"] = owned_array(std::move(frame), {n});
  table["stamp_ns"] = owned_array(std::move(stamp), {n});
  table["truth"] = owned_array(std::move(truth), {n, 4, 4});
  table["estimate"] = owned_array(std::move(estimate), {n, 4, 4});
  table["error_m"] = owned_array(std::move(error), {n});
  table["error_deg"] = owned_array(std::move(rotation), {n});
  table["along_m"] = owned_array(std::move(along), {n});
  table["across_m"] = owned_array(std::move(across), {n});
  table["up_m"] = owned_array(std::move(up), {n});
  table["travelled_m"] = owned_array(std::move(travelled), {n});
  return table;
}

Table group_table(const std::vector<SegmentGroup>& groups) {
  std::vector<double> from, to, t, r;
  std::vector<std::int64_t> segments;
  for (const SegmentGroup& group : groups) {
    from.push_back(group.from);
    to.push_back(group.to);
    segments.push_back(group.segments);
    t.push_back(group.t_percent);
    r.push_back(group.r_deg_per_100m);
  }
  const std::size_t n = from.size();
  Table table;
  table["from"] = owned_array(std::move(from), {n});
  table["to"] = owned_array(std::move(to), {n});
  table["segments"] = owned_array(std::move(segments), {n});
  table["t_percent"] = owned_array(std::move(t), {n});
  table["r_deg_per_100m"] = owned_array(std::move(r), {n});
  return table;
}

Table segment_table(const EvaluationResult& result) {
  std::vector<std::int64_t> first, last;
  std::vector<double> length, t, r, speed;
  for (const SegmentError& segment : result.segments.segments) {
    first.push_back(segment.first_frame);
    last.push_back(segment.last_frame);
    length.push_back(segment.length_m);
    t.push_back(segment.t_percent);
    r.push_back(segment.r_deg_per_100m);
    speed.push_back(segment.speed_m_per_s);
  }
  const std::size_t n = first.size();
  Table table;
  table["first_frame"] = owned_array(std::move(first), {n});
  table["last_frame"] = owned_array(std::move(last), {n});
  table["length_m"] = owned_array(std::move(length), {n});
  table["t_percent"] = owned_array(std::move(t), {n});
  table["r_deg_per_100m"] = owned_array(std::move(r), {n});
  table["speed_m_per_s"] = owned_array(std::move(speed), {n});
  return table;
}

Table error_table(const EvaluationResult& result) {
  std::vector<std::string> key, name, unit;
  std::vector<double> rmse, mean, median, std_dev, min, max, sse, p75, p90, p95, p99;
  std::vector<std::int64_t> count;
  for (const ErrorRow& row : error_rows(result)) {
    key.push_back(row.key);
    name.push_back(row.name);
    unit.push_back(row.unit);
    const Statistics& s = row.statistics;
    for (const auto& [values, value] :
         {std::pair(&rmse, s.rmse), std::pair(&mean, s.mean), std::pair(&median, s.median),
          std::pair(&std_dev, s.std_dev), std::pair(&min, s.min), std::pair(&max, s.max),
          std::pair(&sse, s.sse), std::pair(&p75, s.p75), std::pair(&p90, s.p90),
          std::pair(&p95, s.p95), std::pair(&p99, s.p99)})
      values->push_back(value);
    count.push_back(s.count);
  }
  const std::size_t n = rmse.size();
  Table table;
  table["key"] = key;
  table["name"] = name;
  table["unit"] = unit;
  for (auto& [column, values] :
       {std::pair("rmse", &rmse), std::pair("mean", &mean), std::pair("median", &median),
        std::pair("std", &std_dev), std::pair("min", &min), std::pair("max", &max),
        std::pair("sse", &sse), std::pair("p75", &p75), std::pair("p90", &p90),
        std::pair("p95", &p95), std::pair("p99", &p99)})
    table[column] = owned_array(std::move(*values), {n});
  table["count"] = owned_array(std::move(count), {n});
  return table;
}

/// The steps of one relative error; frames are those of the ground truth.
static Table step_table(const EvaluationResult& result, const RelativeErrors& steps) {
  std::vector<std::int64_t> first, last;
  std::vector<double> translation, rotation, heading, inclination, full, length;
  for (const RelativeError& step : steps.errors) {
    first.push_back(result.aligned_pairs[static_cast<std::size_t>(step.first)].frame);
    last.push_back(result.aligned_pairs[static_cast<std::size_t>(step.last)].frame);
    translation.push_back(step.translation_m);
    rotation.push_back(step.rotation_deg);
    if (steps.has_vertical) {
      heading.push_back(step.heading_deg);
      inclination.push_back(step.inclination_deg);
    }
    full.push_back(step.full);
    length.push_back(step.length_m);
  }
  const std::size_t n = first.size();
  Table table;
  table["first_frame"] = owned_array(std::move(first), {n});
  table["last_frame"] = owned_array(std::move(last), {n});
  table["translation_m"] = owned_array(std::move(translation), {n});
  table["rotation_deg"] = owned_array(std::move(rotation), {n});
  if (steps.has_vertical) {
    table["heading_deg"] = owned_array(std::move(heading), {n});
    table["inclination_deg"] = owned_array(std::move(inclination), {n});
  }
  table["full"] = owned_array(std::move(full), {n});
  table["length_m"] = owned_array(std::move(length), {n});
  return table;
}

Table steps_over(const EvaluationResult& result, const std::string& delta) {
  const Delta wanted = parse_delta(delta);
  for (const RelativeErrors& steps : result.relative)
    if (steps.delta == wanted) return step_table(result, steps);
  require(wanted == Delta{}, "delta " + delta + ": was not among the deltas of the evaluation");
  return step_table(result, result.rpe);
}

Table profile_table(const EvaluationResult& result, const std::string& by) {
  require(by == "speed" || by == "turning_rate" || by == "distance",
          "by: '" + by + "' is none of speed, turning_rate, distance");
  const ErrorProfile& profile = result.profile;
  std::vector<double> from, to, ate, translation, rotation;
  std::vector<std::int64_t> frames;
  for (const ErrorGroup& group : by == "speed"          ? profile.by_speed
                                 : by == "turning_rate" ? profile.by_turning
                                                        : profile.by_distance) {
    from.push_back(group.from);
    to.push_back(group.to);
    frames.push_back(group.frames);
    ate.push_back(group.ate_rmse_m);
    translation.push_back(group.rpe_trans_m);
    rotation.push_back(group.rpe_rot_deg);
  }
  const std::size_t n = from.size();
  Table table;
  table["from"] = owned_array(std::move(from), {n});
  table["to"] = owned_array(std::move(to), {n});
  table["frames"] = owned_array(std::move(frames), {n});
  table["ate_rmse_m"] = owned_array(std::move(ate), {n});
  table["rpe_trans_m"] = owned_array(std::move(translation), {n});
  table["rpe_rot_deg"] = owned_array(std::move(rotation), {n});
  return table;
}

Table worst_table(const std::vector<WorstStretch>& stretches) {
  std::vector<std::int64_t> first, last;
  std::vector<double> from, to, largest;
  for (const WorstStretch& stretch : stretches) {
    first.push_back(stretch.first_frame);
    last.push_back(stretch.last_frame);
    from.push_back(stretch.first_m);
    to.push_back(stretch.last_m);
    largest.push_back(stretch.largest);
  }
  const std::size_t n = first.size();
  Table table;
  table["first_frame"] = owned_array(std::move(first), {n});
  table["last_frame"] = owned_array(std::move(last), {n});
  table["from_m"] = owned_array(std::move(from), {n});
  table["to_m"] = owned_array(std::move(to), {n});
  table["largest_m"] = owned_array(std::move(largest), {n});
  return table;
}

}  // namespace placegraph::python
