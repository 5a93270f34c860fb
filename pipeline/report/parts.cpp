#include <placegraph/pipeline/report/parts.h>

#include <placegraph/eval/plots/plot.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/tables/column.h>

namespace placegraph::report {

using nlohmann::json;

json bare_report(const std::string& program, const std::string& title) {
  return {{"format", "placegraph-report-1"}, {"program", program},        {"title", title},
          {"runs", json::array()},           {"pictures", json::array()}, {"tables", json::array()},
          {"graphs", json::array()}};
}

json bare_run(const std::string& name, json frames) {
  const json nothing = column(std::vector<std::int32_t>()), no_texts = text_column({});
  const json no_points = column(std::vector<float>(), 3);
  json run = {
      {"name", name},
      {"folder", ""},
      {"recording", ""},
      {"sensor", nullptr},
      {"metric", true},
      {"aligned", nullptr},
      {"up", nullptr},
      {"judgement", nullptr},
      {"options", nullptr},
      {"camera", nullptr},
      {"frames", std::move(frames)},
      {"keyframes",
       {{"id", nothing},
        {"frame", nothing},
        {"place", nothing},
        {"thumbnails", json::array()},
        {"tracks", nullptr}}},
      {"landmarks",
       {{"position", no_points}, {"colour", nullptr}, {"sigma_m", nullptr}, {"keyframe", nothing}}},
      {"places",
       {{"id", nothing}, {"keyframe", nothing}, {"component", nothing}, {"position", no_points}}},
      {"constraints", {{"from", nothing}, {"to", nothing}, {"source", no_texts}}},
      {"loops", nullptr},
      {"street_map", nullptr},
      {"georeference", nullptr}};
  run["summary"] = json::object();
  for (const char* name : {"frames", "posed", "keyframes", "places", "landmarks", "loops_accepted",
                           "cpu_s", "wall_s", "path_length"})
    run["summary"][name] = nullptr;
  for (const char* list :
       {"notes", "figures", "tables", "components", "planes", "floor_plan", "pictures",
        "frame_series"})
    run[list] = json::array();
  return run;
}

json bare_frames(const std::vector<std::int32_t>& id, const std::vector<double>& stamp_s) {
  const std::vector<std::int32_t> none(id.size(), -1);
  json frames = {{"id", column(id)},
                 {"stamp_s", column(stamp_s)},
                 {"component", column(none)},
                 {"keyframe", column(none)},
                 {"pose", pose_column(std::vector<std::optional<Eigen::Isometry3d>>(id.size()))},
                 {"reason", text_column(std::vector<std::string>(id.size()))}};
  for (const char* name : {"online", "truth", "error_m", "error_deg", "sigma_m", "confidence",
                           "inliers", "environment"})
    frames[name] = nullptr;
  return frames;
}

json pose_column(const std::vector<std::optional<Eigen::Isometry3d>>& poses) {
  std::vector<float> values;
  values.reserve(7 * poses.size());
  for (const std::optional<Eigen::Isometry3d>& T : poses) {
    if (!T) {
      values.insert(values.end(), 7, kUnknown);
      continue;
    }
    for (int i = 0; i < 3; ++i) values.push_back(static_cast<float>(T->translation()[i]));
    const Eigen::Quaterniond q(T->rotation());
    for (int i = 0; i < 4; ++i) values.push_back(static_cast<float>(q.coeffs()[i]));
  }
  return column(values, 7);
}

json up_axis(const std::vector<std::optional<Eigen::Vector3d>>& positions_m) {
  const auto [first, second] = top_view_axes(positions_m);
  const int up = 3 - first - second;
  std::array<int, 3> axis = {0, 0, 0};
  axis[static_cast<std::size_t>(up)] = up == 1 ? -1 : 1;
  return axis;
}

json describe_figures(const std::vector<Metric>& metrics) {
  json figures = json::array();
  for (const Metric& metric : metrics)
    if (metric.value && std::isfinite(*metric.value))
      figures.push_back({{"name", metric.name},
                         {"value", *metric.value},
                         {"unit", metric.unit},
                         {"protocol", metric.protocol}});
  return figures;
}

json describe_table(const std::string& title, const std::string& protocol,
                    const std::vector<std::string>& columns,
                    const std::vector<std::vector<std::string>>& rows) {
  return {{"title", title}, {"protocol", protocol}, {"columns", columns}, {"rows", rows}};
}

json describe_picture(const std::string& title, const std::string& caption,
                      const std::string& svg) {
  return {{"title", title}, {"caption", caption}, {"svg", svg}};
}

}  // namespace placegraph::report
