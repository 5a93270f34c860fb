// Turns a folder of PNG images into the same ones as BMP, by the installed library and its module.
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>

#include <cstdio>
#include <filesystem>

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: pictures PNG_FOLDER BMP_FOLDER\n");
    return 2;
  }
  int pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    const placegraph::Image grey = placegraph::read_image(entry.path().string()).grey;
    const std::string name = entry.path().stem().string() + ".bmp";
    placegraph::write_image((std::filesystem::path(argv[2]) / name).string(), grey);
    ++pictures;
  }
  std::printf("%d pictures\n", pictures);
  return pictures > 0 ? 0 : 1;
} catch (const placegraph::Error& error) {
  std::printf("%s\n", error.what());
  return 1;
}
