// Rounding bounds of single precision that C++ and GLSL traversals share; all relative.
#ifndef ENCORE_SHADERS_SHARED_TOLERANCE_H
#define ENCORE_SHADERS_SHARED_TOLERANCE_H

// A plane distance t = (plane - origin) * (1 / direction) takes a subtraction and a product, each
// correctly rounded, and a reciprocal that C++ rounds correctly but GLSL only to 2.5 ulp: at most
// 3.5 ulp (relative 7 * 2^-24) from the exact value, however far the origin is away. Two distances
// that differ by less than twice that may be in either order.
#define ENCORE_UNIT_ROUNDOFF 5.9604644775390625e-08f  // 2^-24
#define ENCORE_PLANE_SLACK 9.5367431640625e-07f       // 16 * 2^-24

// The triangle filter (accel/triangle_filter.h derives them): every sum of products is off by at
// most ENCORE_FILTER_ERROR * (32 * edge * reach) + ENCORE_FILTER_UNDERFLOW. GPUs may round each
// operation as they like within 1 ulp and flush numbers below the normal range to zero, which the
// bound's factor of two and the second term cover.
#define ENCORE_FILTER_LARGEST 32.0f
#define ENCORE_FILTER_ERROR 5.066394805908203125e-07f    // 2 * 136 * 2^-24 / 32
#define ENCORE_FILTER_UNDERFLOW 1.2037062152420224e-35f  // 2^-116

// The watertight test (accel/triangle_watertight.h derives them): edge functions are off by at most
// ENCORE_WATERTIGHT_ERROR * (8 * lateral * reach) + ENCORE_FILTER_UNDERFLOW, distances relatively
// by ENCORE_WATERTIGHT_DISTANCE; numbers outside the ranges below are left to double precision.
#define ENCORE_WATERTIGHT_RESULT 8.0f
#define ENCORE_WATERTIGHT_ERROR 2.384185791015625e-07f       // 2 * 16 * 2^-24 / 8
#define ENCORE_WATERTIGHT_DISTANCE 1.52587890625e-05f        // 2^-16
#define ENCORE_WATERTIGHT_SMALL 7.888609052210118e-31f       // 2^-100
#define ENCORE_WATERTIGHT_LARGE 1.2676506002282294e+30f      // 2^100
#define ENCORE_WATERTIGHT_EDGE_SMALL 9.094947017729282e-13f  // 2^-40
#define ENCORE_WATERTIGHT_EDGE_LARGE 1.099511627776e+12f     // 2^40
#define ENCORE_WATERTIGHT_NORMAL 16.5f
#define ENCORE_WATERTIGHT_NORMAL_UNDERFLOW 7.52316384526264e-37f  // 2^-120

// The final decision, in double precision (accel/triangle_hit.cpp derives them).
#define ENCORE_SLOPE_ROUNDING 3.552713678800501e-15  // 2^-48
#define ENCORE_SLOPE_SAFE 9.5367431640625e-07        // 2^-20

#endif
