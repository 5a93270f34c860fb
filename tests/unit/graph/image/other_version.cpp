// A module of an older version.
#include <cstdint>

extern "C" std::int64_t placegraph_picture_plugin_version() { return 7; }
extern "C" const void* placegraph_picture_plugin() { return nullptr; }
