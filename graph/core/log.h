#pragma once
#include <functional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// How important a message is, in ascending order; an error is an exception instead.
enum class LogLevel { kDebug, kInfo, kWarning };

/// Receives the messages of the call that it is passed to; there is no global log. An empty sink
/// discards them.
using LogSink = std::function<void(LogLevel, const std::string&)>;

}  // namespace placegraph
