// One thread for each of so many things (renderer/gpu_each.h).
layout(local_size_x = ENCORE_GROUP_SIZE) in;

uniform uint thread_count;

uint group_index() {
  return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}

// Which of them; thread_count or more: none.
uint thread_index() {
  return group_index() * uint(ENCORE_GROUP_SIZE) + gl_LocalInvocationID.x;
}
