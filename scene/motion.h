#pragma once

#include "scene/animation.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <memory>

namespace encore::scene {

/// Length of one loop of a motion in seconds: time of the last key, period of the deformer, frames
/// by frame rate. 0 if nothing ever moves (a single key or frame, amplitude or frequency 0).
double motion_duration_s(const Motion& motion);

/// `time_s` brought into [0, duration_s); 0 if the duration is 0 or the time is not finite.
double wrapped_time(double time_s, double duration_s);

/// Pose of a rigid part. Exactly a key's own pose at its time, held outside the keys. Between two
/// keys of the same axis the angle is interpolated (so that a wheel may turn by 720 degrees);
/// between different axes the rotation goes along the shorter arc.
glm::mat4 pose_at(const RigidMotion& motion, double time_s);

/// Index of the frame shown at a time; the sequence repeats.
std::size_t frame_at(const FrameSequence& sequence, double time_s);

}  // namespace encore::scene
