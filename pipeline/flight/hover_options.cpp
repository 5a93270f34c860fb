#include <placegraph/pipeline/flight/hover_options.h>

namespace placegraph {

void visit(OptionVisitor& field, HoverOptions& o) {
  field("floor_z_m", o.floor_z_m, "height of the floor in the world", {-1e6, 1e6});
  visit(field, o.flow);
  field("marker_delay_s", o.marker_delay_s, "poses by markers come so much after their image",
        {0, 60});
  visit(field, o.marker_sensor);
  field.group("tracker", o.flow.tracker, "corners of the floor that are followed");
  field.group("start", o.start, "what a body that begins does not know");
  field.group("filter", o.filter, "how the sensors err, and what is believed");
  field("map_interval_s", o.map_interval_s,
        "between images that are searched whole for markers to be mapped", {0, 60});
  field.group("map", o.map, "markers whose place is not known");
}

void HoverOptions::check() const { check_ranges(*this); }

}  // namespace placegraph
