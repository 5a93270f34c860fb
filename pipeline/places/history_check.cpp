#include <placegraph/pipeline/places/history_check.h>
#include <placegraph/pipeline/places/place_mapper.h>

namespace placegraph {

void check_history(const std::vector<Place>& places, const PlaceHistory& history) {
  (void)PlaceMapper(PlaceOptions(), IncrementalOptions(), places, history);
}

}  // namespace placegraph
