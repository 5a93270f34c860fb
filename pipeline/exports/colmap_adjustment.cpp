#include <placegraph/io/exports/colmap_reader.h>
#include <placegraph/pipeline/exports/colmap_adjustment.h>
#include <placegraph/pipeline/exports/colmap_folder.h>
#include <placegraph/pipeline/map/colmap_bundle.h>

#include <utility>

namespace placegraph {

struct ColmapAdjustment::Parts {
  std::string folder;
  ColmapModel model;
};

ColmapAdjustment::ColmapAdjustment(std::string folder) : parts_(std::make_unique<Parts>()) {
  parts_->model = read_colmap(folder, ColmapLenses::kAny);
  parts_->folder = std::move(folder);
}

ColmapAdjustment::~ColmapAdjustment() = default;

ColmapAdjustmentReport ColmapAdjustment::adjust(const BundleOptions& options) {
  ColmapBundleReport report = adjust_colmap(parts_->model, options);
  const ColmapAdjustmentReport result{.outcome = report.outcome,
                                      .images = parts_->model.images.size(),
                                      .points = parts_->model.points.size(),
                                      .observations = report.observations,
                                      .cost_initial = report.cost_initial,
                                      .cost_final = report.cost_final,
                                      .error_before_px = report.error_before_px,
                                      .error_px = report.error_px,
                                      .iterations = report.iterations};
  parts_->model = std::move(report.model);
  return result;
}

void ColmapAdjustment::write(const std::string& folder) const {
  write_colmap_folder(folder, parts_->model, colmap_form(parts_->folder));
}

}  // namespace placegraph
