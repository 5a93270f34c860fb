#pragma once
#include <string>

#include "apps/config/config.h"

namespace placegraph::apps {

/// The options of `placegraph flight run` after the file and the settings, as a text.
/// Throws ArgumentError, FileError.
std::string config_of_flight(const ConfigArguments& arguments);

}  // namespace placegraph::apps
