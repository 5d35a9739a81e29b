// What the passes of a picture that takes more than one ray a pixel share (renderer/gpu_paths.h says
// how they follow each other): a path a pixel of the band in hand, and lists of paths.
#include "numbers.glsl"
#include "shaders/shared/bindings.h"
#include "shaders/shared/path_types.h"

layout(std430, binding = ENCORE_BINDING_PATHS) restrict buffer Paths {
  Path paths[];
};
// Counts (ENCORE_QUEUE_WORDS), then lists.
layout(std430, binding = ENCORE_BINDING_PATH_QUEUES) restrict buffer PathQueues {
  uint path_queues[];
};
