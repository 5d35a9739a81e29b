#pragma once

#include "scene/samples/vector_math.h"
#include "scene/scene.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Putting sample scenes together.
namespace encore::scene::samples {

/// A Phong material: diffuse colour, strength of the highlight in [0, 1], and its exponent.
Material paint(const std::string& name, const glm::vec3& color, float shine = 0.25F,
               float exponent = 40.0F);

/// An empty scene with the thesis' camera, a warm key light beside it, a cool fill light from the
/// left, and a dark background.
Scene stage(const std::string& name);

std::shared_ptr<const Model> make_model(const std::string& name, Mesh mesh,
                                        std::vector<Material> materials);

/// Adds an instance. A model that is placed again shares its materials with its first instance.
Instance& place(Scene& scene, std::shared_ptr<const Model> model,
                const glm::mat4& transform = glm::mat4(1.0F));

/// A scene of one model as it is.
Scene single(const std::string& name, Mesh mesh, std::vector<Material> materials);

/// Triangles of all instances at time 0.
std::size_t triangle_count(const Scene& scene);

/// How many triangles the scene lacks of `total`. Throws std::logic_error if it has more already.
std::size_t missing_to(const Scene& scene, std::size_t total);

/// One pose of a part within a scene that as a whole is turned by a fixed frame.
struct Pose {
  Vec position{0.0};
  Vec axis{0.0, 1.0, 0.0};
  double degrees = 0.0;
};

/// A motion that loops smoothly: `pose` gives the pose at a share in [0, 1] of the loop and must
/// agree at both ends; `keys` keyframes are taken from it, close enough that no part turns half
/// around between two. `whole` turns the scene, and with it positions and axes.
RigidMotion looping(const Frame& whole, double seconds, int keys,
                    const std::function<Pose(double)>& pose);

}  // namespace encore::scene::samples
