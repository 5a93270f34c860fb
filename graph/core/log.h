#pragma once
#include <functional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

enum class LogLevel { kDebug, kInfo, kWarning };

/// Where messages go: handed to whoever wants to speak, never global. Empty means silence.
using LogSink = std::function<void(LogLevel, const std::string&)>;

}  // namespace placegraph
