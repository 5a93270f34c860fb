#include <placegraph/io/files/output_file.h>
#include <placegraph/pipeline/exports/colmap_folder.h>

#include <filesystem>
#include <utility>

namespace placegraph {

void write_colmap_folder(const std::string& folder, const ColmapModel& model, NumberForm form) {
  namespace fs = std::filesystem;
  const ColmapFiles files = to_colmap(model, form);
  const OutputFolder made(folder);
  const bool binary = form == NumberForm::kBinary;
  for (const auto& [name, content] :
       {std::pair("cameras", &files.cameras), std::pair("images", &files.images),
        std::pair("points3D", &files.points)}) {
    const fs::path path = fs::path(folder) / name;
    write_file(path.string() + (binary ? ".bin" : ".txt"), *content);
    std::error_code ignored;
    fs::remove(path.string() + (binary ? ".txt" : ".bin"), ignored);
  }
  for (const char* name : {"rigs.bin", "rigs.txt", "frames.bin", "frames.txt"}) {
    std::error_code ignored;
    fs::remove(fs::path(folder) / name, ignored);
  }
}

}  // namespace placegraph
