#define PLACEGRAPH_EXTERN
#include "placegraph/graph/internal/core/eigen_instances.h"
