#define PLACEGRAPH_EXTERN
#include "placegraph/graph/core/eigen_instances.h"
