#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/sensors/euroc_sensor.h>

namespace placegraph {

SE3 read_T_body_sensor(const YamlDocument& yaml) {
  const YAML::Node T_BS = yaml.member(yaml.root(), "T_BS");
  const std::vector<double> data = yaml.numbers(T_BS, "data", 16);
  const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> T(data.data());
  if ((T.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > 1e-9) {
    yaml.fail(T_BS, "T_BS: the last row is not 0 0 0 1");
  }
  try {
    return SE3(Eigen::Matrix3d(T.topLeftCorner<3, 3>()), Eigen::Vector3d(T.topRightCorner<3, 1>()));
  } catch (const ArgumentError& error) {
    yaml.fail(T_BS, fmt::format("T_BS: {}", error.what()));
  }
}

std::string T_body_sensor_yaml(const SE3& T_body_sensor) {
  const Eigen::Matrix4d T = T_body_sensor.matrix();
  std::string text = "T_BS:\n  cols: 4\n  rows: 4\n  data: [";
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      text += fmt::format("{}{:.15g}",
                          row + column == 0 ? ""
                          : column == 0     ? ",\n         "
                                            : ", ",
                          T(row, column));
  return text + "]\n";
}

}  // namespace placegraph
