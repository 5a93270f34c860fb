#include <placegraph/eval/plots/street_map_plot.h>
#include <placegraph/eval/scene/street_map_check.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/io/scene/labelled_mesh_file.h>
#include <placegraph/io/scene/street_map_file.h>
#include <placegraph/pipeline/lens_correction.h>
#include <placegraph/pipeline/results/plot_beside.h>
#include <placegraph/pipeline/results/run_judgement.h>
#include <placegraph/pipeline/results/street_map_files.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json score_json(const StreetMapCheck::Score& score) {
  const double n = std::max<double>(1, static_cast<double>(score.cells));
  return {{"cells", score.cells},
          {"right_share", score.share()},
          {"most_share", static_cast<double>(score.most) / n},
          {"nothing_share", static_cast<double>(score.nothing) / n}};
}

json check_json(const StreetMapCheck& check, const StreetMap& map) {
  json confusion;
  const std::size_t n = map.classes.size();
  for (std::size_t c = 0; c < n; ++c) {
    const auto begin = check.confusion.begin() + static_cast<std::ptrdiff_t>(c * n);
    if (std::any_of(begin, begin + static_cast<std::ptrdiff_t>(n), [](auto k) { return k > 0; }))
      confusion[map.classes[c]] =
          std::vector<std::int64_t>(begin, begin + static_cast<std::ptrdiff_t>(n));
  }
  return {{"all", score_json(check.all)},
          {"top", score_json(check.top)},
          {"unjudged", check.unjudged},
          {"confusion", confusion}};
}

std::vector<std::pair<PlaceId, std::vector<float>>> shares_by_place(const StreetMapper& mapper,
                                                                    const Map& map) {
  const std::vector<std::vector<float>> shares = class_shares(mapper, map);
  std::vector<std::pair<PlaceId, std::vector<float>>> result;
  for (std::size_t i = 0; i < shares.size(); ++i)
    result.emplace_back(map.place_graph.places[i].id, shares[i]);
  return result;
}

}  // namespace

StreetMapper make_street_mapper(const Map& map, const Calibration& calibration,
                                const Dataset& dataset, Sensor sensor, double lens_k1,
                                const StreetMapperOptions& options, StreetMapModels models,
                                const std::function<void(std::size_t, std::size_t)>& progress) {
  StreetMapper mapper(options, calibration, std::move(models.urban), std::move(models.surfaces));
  if (!map.metric || calibration.baseline_m <= 0)
    return mapper;  // street labelling needs a metric map and a baseline
  LensCorrection lens(dataset.calibration(sensor));
  if (lens_k1 != 0) lens.add(lens_k1);
  add_keyframes(
      mapper, map, options,
      [&](const Keyframe& keyframe) {
        Frame frame = dataset.frame(static_cast<std::size_t>(keyframe.frame.value()), sensor);
        if (lens_k1 != 0) lens.apply(frame);
        return frame;
      },
      [&](std::size_t done, std::size_t total) {
        if (progress) progress(done, total);
      });
  return mapper;
}

void write_street_map(const std::string& folder, const StreetMap& semantic,
                      const StreetMapper& mapper, const Map& map,
                      const KeyframePoses& T_frame_keyframe, const std::string& title,
                      const std::optional<GeodeticPosition>& origin, const LogSink& log) {
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  StreetMapPicture picture;
  picture.title = title;
  for (const Keyframe& keyframe : map.keyframes) {
    const std::optional<SE3> T = T_frame_keyframe(keyframe.id);
    picture.path.emplace_back();
    if (!T) continue;
    const Eigen::Vector3d p = semantic.R_plan_map.matrix() * T->translation();
    picture.path.back() = Eigen::Vector2d(p[0], p[2]);
  }
  write_file(path("semantic_map.ply"), to_ply(semantic));
  write_file(path("semantic_map.json"), to_json(semantic, shares_by_place(mapper, map)));
  write_plot_beside(path("semantic_map.png"), street_map_svg(semantic, picture), log);
  if (origin) write_file(path("semantic_map.geojson"), to_geojson(semantic, *origin));
}

namespace {

json describe_street_map(const StreetMap& semantic, const StreetMapper& mapper, const Map& map,
                         const Dataset& dataset, const std::string& sequence) {
  json summary = {{"outcome", to_string(semantic.outcome.code)}};
  if (!semantic.outcome) {
    summary["reason"] = semantic.outcome.reason;
    return summary;
  }
  summary["keyframes"] = mapper.observations().size();
  summary["cells"] = std::count_if(semantic.cells.begin(), semantic.cells.end(),
                                   [](const StreetCell& cell) { return cell.label >= 0; });
  const fs::path truth_path = fs::path(sequence) / "scene.ply";
  const auto& truth = dataset.ground_truth();
  if (!fs::exists(truth_path) || !truth || truth->size() != dataset.size()) return summary;
  const LabelledMesh scene = read_labelled_mesh(truth_path.string());
  summary["check"]["optimized"] = check_json(
      check_street_map(semantic, scene, fit_by_first_pose(*truth, map, map.trajectory_optimized())),
      semantic);
  const StreetMap before = mapper.fuse(online_poses_of(map));
  if (before.outcome)
    summary["check"]["online"] = check_json(
        check_street_map(before, scene, fit_by_first_pose(*truth, map, map.trajectory_online)),
        before);
  return summary;
}

}  // namespace

std::string street_map_json(const StreetMap& semantic, const StreetMapper& mapper, const Map& map,
                            const Dataset& dataset, const std::string& sequence) {
  return describe_street_map(semantic, mapper, map, dataset, sequence)
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace placegraph
