// How light goes on at a surface (twin of renderer/paths/scatter.cpp; scatter.h states it). In double
// precision and as it is written, so that GPU and CPU send the very same rays on.
#include "numbers.glsl"
#include "shaders/shared/path_types.h"

const double kOriginLift = 4.76837158203125e-7lf;  // 2^-21
const float kLeastWeight = 0.0009765625;           // 2^-10
const float kShadowReach = 0.99999904632568359375;  // 1 - 2^-20

struct SurfacePoint {
  dvec3 point;
  dvec3 geometric;
  dvec3 normal;
  double reach;
  bool entering;
};

double dot_product(dvec3 a, dvec3 b) {
  precise double sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}

double largest_coordinate(dvec3 v) {
  return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// `smooth_normal`: the interpolated one, of any length; zero where there is none.
SurfacePoint surface_point(vec3 ray_direction, Hit hit, vec3 v0, vec3 v1, vec3 v2,
                           dvec3 smooth_normal) {
  dvec3 corner = dvec3(v0);
  precise dvec3 edge1 = dvec3(v1) - corner;
  precise dvec3 edge2 = dvec3(v2) - corner;
  dvec3 view = -dvec3(ray_direction);
  precise dvec3 point = corner + edge1 * double(hit.u) + edge2 * double(hit.v);
  precise dvec3 facing = dvec3(edge1.y * edge2.z - edge2.y * edge1.z,
                               edge1.z * edge2.x - edge2.z * edge1.x,
                               edge1.x * edge2.y - edge2.x * edge1.y);
  double squared_area = dot_product(facing, facing);

  SurfacePoint at;
  at.point = point;
  at.reach = max(max(largest_coordinate(point), largest_coordinate(corner)),
                 max(largest_coordinate(dvec3(v1)), largest_coordinate(dvec3(v2))));
  at.entering = !(dot_product(facing, view) < 0.0lf);
  at.geometric = view;
  at.normal = view;
  if (!(squared_area > 0.0lf)) return at;
  precise double scale = (at.entering ? 1.0lf : -1.0lf) / sqrt(squared_area);
  precise dvec3 geometric = facing * scale;
  at.geometric = geometric;
  at.normal = geometric;
  double squared = dot_product(smooth_normal, smooth_normal);
  if (squared > 0.0lf) {
    double side = dot_product(smooth_normal, geometric) < 0.0lf ? -1.0lf : 1.0lf;
    precise double smooth_scale = side / sqrt(squared);
    precise dvec3 normal = smooth_normal * smooth_scale;
    at.normal = normal;
  }
  return at;
}

vec3 lifted_origin(SurfacePoint at, dvec3 side) {
  precise double lift = kOriginLift * at.reach;
  precise dvec3 origin = at.point + side * lift;
  return vec3(origin);
}

// Nothing (false) if the light is not on the viewer's side or adds nothing.
bool shadow_ray(SurfacePoint at, vec3 light, out vec3 origin, out vec3 direction,
                out float t_max) {
  dvec3 place = dvec3(light);
  precise dvec3 from_point = place - at.point;
  if (!(dot_product(at.normal, from_point) > 0.0lf)) return false;
  origin = lifted_origin(at, at.geometric);
  precise dvec3 way = place - dvec3(origin);
  if (!(dot_product(at.geometric, way) > 0.0lf)) return false;
  precise double distance_to_light = sqrt(dot_product(way, way));
  precise double scale = 1.0lf / distance_to_light;
  precise dvec3 along = way * scale;
  direction = vec3(along);
  precise float reach = float(distance_to_light) * kShadowReach;
  t_max = reach;
  return true;
}

#ifdef ENCORE_BOUNCES
struct Continuation {
  bool goes_on;
  vec3 origin;
  vec3 direction;
  vec3 weight;
};

struct Scattering {
  Continuation reflection;
  Continuation refraction;
};

// What a smooth boundary does to a ray.
struct Boundary {
  bool total;
  double mirrored;
  dvec3 direction;
};

dvec3 mirrored_about(dvec3 along, dvec3 normal) {
  precise double twice = 2.0lf * dot_product(along, normal);
  precise dvec3 back = along - normal * twice;
  return back;
}

dvec3 mirrored_direction(dvec3 along, dvec3 normal, dvec3 geometric) {
  dvec3 back = mirrored_about(along, normal);
  return dot_product(back, geometric) > 0.0lf ? back : mirrored_about(along, geometric);
}

double fresnel(double cosine, double eta, double through) {
  precise double across = (eta * cosine - through) / (eta * cosine + through);
  precise double level = (eta * through - cosine) / (eta * through + cosine);
  precise double part = 0.5lf * (across * across + level * level);
  return part;
}

Boundary refracted_about(dvec3 along, dvec3 normal, double eta) {
  if (eta == 1.0lf) return Boundary(false, 0.0lf, along);
  double cosine = min(-dot_product(along, normal), 1.0lf);
  precise double squared = 1.0lf - eta * eta * (1.0lf - cosine * cosine);
  if (!(squared > 0.0lf)) return Boundary(true, 1.0lf, dvec3(0.0lf));
  precise double through = sqrt(squared);
  precise double aside = eta * cosine - through;
  precise dvec3 direction = along * eta + normal * aside;
  return Boundary(false, fresnel(cosine, eta, through), direction);
}

Boundary cross_boundary(dvec3 along, dvec3 normal, SurfacePoint at, float given) {
  double index = given > 0.0 ? double(given) : 1.0lf;
  precise double eta = at.entering ? 1.0lf / index : index;
  Boundary about_normal = refracted_about(along, normal, eta);
  if (about_normal.total || dot_product(about_normal.direction, at.geometric) < 0.0lf) {
    return about_normal;
  }
  return refracted_about(along, at.geometric, eta);
}

// `count`: the share of the light that goes on; `weight`: of the ray that came.
Continuation go_on(SurfacePoint at, dvec3 side, dvec3 direction, dvec3 count, vec3 weight) {
  precise vec3 here = vec3(count) * weight;
  if (!(max(max(here.r, here.g), here.b) >= kLeastWeight)) {
    return Continuation(false, vec3(0.0), vec3(0.0), vec3(0.0));
  }
  precise double scale = 1.0lf / sqrt(dot_product(direction, direction));
  precise dvec3 unit = direction * scale;
  return Continuation(true, lifted_origin(at, side), vec3(unit), here);
}

double share_of(float value) {
  return min(max(double(value), 0.0lf), 1.0lf);
}

dvec3 mirror_tint(vec3 specular_color) {
  dvec3 specular = dvec3(specular_color);
  precise double mean = (specular.r + specular.g + specular.b) / 3.0lf;
  precise dvec3 tint = specular / mean;
  return mean > 0.0lf ? tint : dvec3(1.0lf);
}

// The shares of light that a material mirrors and lets through.
void split(Bounce material, out double mirror, out double glass) {
#ifdef ENCORE_REFLECTIONS
  mirror = share_of(material.reflectivity);
#else
  mirror = 0.0lf;
#endif
#ifdef ENCORE_REFRACTIONS
  precise double rest = (1.0lf - mirror) * (1.0lf - share_of(material.opacity));
  glass = rest;
#else
  glass = 0.0lf;
#endif
}

// The share that is Phong's.
float own_share(Bounce material) {
  double mirror, glass;
  split(material, mirror, glass);
  precise double own = (1.0lf - mirror) - glass;
  return float(own);
}

// What goes on, with weights that are those of the whole way to the eye.
Scattering scatter(vec3 ray_direction, SurfacePoint at, Bounce material, vec3 weight) {
  Continuation nothing = Continuation(false, vec3(0.0), vec3(0.0), vec3(0.0));
  Scattering result = Scattering(nothing, nothing);
  double mirror, glass;
  split(material, mirror, glass);
  if (!(mirror > 0.0lf || glass > 0.0lf)) return result;

  dvec3 along = dvec3(ray_direction);
  dvec3 normal = dot_product(along, at.normal) < 0.0lf ? at.normal : at.geometric;
  dvec3 back = mirrored_direction(along, normal, at.geometric);
  precise dvec3 mirrored_share = mirror_tint(material.specular) * mirror;
#ifdef ENCORE_REFRACTIONS
  if (glass > 0.0lf) {
    Boundary boundary = cross_boundary(along, normal, at, material.index_of_refraction);
    if (boundary.total) {
      result.refraction = go_on(at, at.geometric, back, dvec3(glass), weight);
    } else {
      precise double mirrored_glass = glass * boundary.mirrored;
      mirrored_share += dvec3(mirrored_glass);
      precise double through = glass * (1.0lf - boundary.mirrored);
      result.refraction = go_on(at, -at.geometric, boundary.direction, dvec3(through), weight);
    }
  }
#endif
#ifdef ENCORE_REFLECTIONS
  result.reflection = go_on(at, at.geometric, back, mirrored_share, weight);
#endif
  return result;
}
#endif
