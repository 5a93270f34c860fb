#include "apps/config/flight_config.h"

#include <placegraph/pipeline/flight/flight_options.h>

#include "apps/config/config_of.h"

namespace placegraph::apps {

std::string config_of_flight(const ConfigArguments& arguments) {
  return config_of<FlightOptions>(arguments);
}

}  // namespace placegraph::apps
