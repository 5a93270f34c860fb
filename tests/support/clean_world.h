#pragma once
#include <placegraph/io/synthetic/worlds/synthetic_world.h>

#include <string>

namespace placegraph::test {

/// Options of a world without noise, seen by images of `width` x `height` pixels.
inline SyntheticOptions clean_world(const std::string& name, int frames, int width, int height) {
  SyntheticOptions options;
  options.world = name;
  options.difficulty = synthetic::Difficulty::kClean;
  options.frames = frames;
  options.width = width, options.height = height;
  return options;
}

}  // namespace placegraph::test
