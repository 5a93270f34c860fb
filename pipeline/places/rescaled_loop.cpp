#include <placegraph/pipeline/places/rescaled_information.h>
#include <placegraph/pipeline/places/rescaled_loop.h>

namespace placegraph {

Loop rescaled_loop(Loop loop, bool at_match, bool at_query, double factor) {
  if (at_match) {
    loop.T_match_query = loop.T_match_query.scaled(factor);
    loop.scale_match_query *= factor;
  }
  if (at_query) {
    loop.information = rescaled_information<7>(loop.information, factor);
    loop.scale_match_query /= factor;
  }
  return loop;
}

}  // namespace placegraph
