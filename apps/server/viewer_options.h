#pragma once

namespace placegraph::apps {

/// How a page that is served is reached.
struct ViewerOptions {
  int port = 0;       ///< port on 127.0.0.1; 0: a free one
  bool open = false;  ///< whether the page is opened in the user's browser
};

}  // namespace placegraph::apps
