#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/body_state_file.h>
#include <placegraph/io/trajectories/repeated_rows.h>

#include <cmath>

namespace placegraph {
namespace {

std::vector<StampedPose> poses_of(const std::vector<BodyState>& states) {
  std::vector<StampedPose> poses;
  for (const BodyState& state : states)
    poses.push_back({state.stamp_ns, state.T_world_body.isometry()});
  return poses;
}

}  // namespace

std::vector<BodyState> read_body_states(const std::string& path, const LogSink& log) {
  TextFile file(path);
  std::vector<BodyState> states;
  std::vector<RepeatedStamp> repeated;
  std::string_view line;
  std::vector<std::string_view> fields;
  constexpr std::size_t kColumns = 17;
  while (file.next_data(line)) {
    split_comma(line, fields);
    if (fields.size() != kColumns)
      file.fail(
          fmt::format("expected t_ns and 16 numbers (position, quaternion, velocity, biases), "
                      "found {} columns",
                      fields.size()));
    BodyState state;
    state.stamp_ns = file.integer(fields[0], "time [ns]");
    if (!states.empty() && state.stamp_ns < states.back().stamp_ns)
      file.fail(fmt::format("time {} ns does not increase", state.stamp_ns));
    double v[kColumns - 1];
    for (std::size_t i = 0; i + 1 < kColumns; ++i) v[i] = file.number(fields[i + 1], "state");
    const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
    constexpr double kUnitTolerance = 1e-2;
    if (std::abs(q.norm() - 1) > kUnitTolerance)
      file.fail(fmt::format("the quaternion has length {:.4f}, not 1", q.norm()));
    state.T_world_body = SE3(SO3(q), Eigen::Vector3d(v[0], v[1], v[2]));
    state.velocity_world = {v[7], v[8], v[9]};
    state.gyro_bias = {v[10], v[11], v[12]};
    state.accel_bias = {v[13], v[14], v[15]};
    if (!states.empty() && state.stamp_ns == states.back().stamp_ns)
      repeated.push_back({static_cast<std::size_t>(file.line()), states.size() - 1,
                          state.T_world_body.isometry()});
    else
      states.push_back(state);
  }
  if (states.empty()) throw FileError(path, "holds no states");
  const std::string warning = repeated_rows_warning(path, poses_of(states), repeated);
  if (!warning.empty() && log) log(LogLevel::kWarning, warning);
  return states;
}

void write_body_states(const std::string& path, const std::vector<BodyState>& states) {
  AtomicFile file(path);
  file.stream() << "#timestamp [ns],p_x [m],p_y,p_z,q_w,q_x,q_y,q_z,v_x [m/s],v_y,v_z,"
                   "b_w_x [rad/s],b_w_y,b_w_z,b_a_x [m/s^2],b_a_y,b_a_z\n";
  for (const BodyState& s : states) {
    const Eigen::Vector3d& p = s.T_world_body.translation();
    const Eigen::Quaterniond& q = s.T_world_body.rotation().quaternion();
    file.stream() << fmt::format("{},{:.9f},{:.9f},{:.9f},{:.12f},{:.12f},{:.12f},{:.12f}",
                                 s.stamp_ns, p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z());
    for (const Eigen::Vector3d& v : {s.velocity_world, s.gyro_bias, s.accel_bias})
      file.stream() << fmt::format(",{:.9f},{:.9f},{:.9f}", v.x(), v.y(), v.z());
    file.stream() << '\n';
  }
  file.commit();
}

}  // namespace placegraph
