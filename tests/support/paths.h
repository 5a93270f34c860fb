#pragma once
#include <string>

namespace placegraph::test {

/// Folders and programs of this build. They are compiled in one source alone, so that all other
/// objects are the same in every clone and the compiler cache finds them.
std::string source_dir();    ///< the project's root
std::string program();       ///< the command `placegraph`
std::string examples_dir();  ///< where the examples are built

}  // namespace placegraph::test
