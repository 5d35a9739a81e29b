// Rays towards the light in hand; how many is in the path queues.
#include "shaders/shared/bindings.h"
#include "shaders/shared/path_types.h"

layout(std430, binding = ENCORE_BINDING_SHADOW_RAYS) restrict buffer ShadowRays {
  ShadowRay shadow_rays[];
};
