#pragma once

#include <embree3/rtcore.h>

namespace encore::app::bench {

/// Embree 3's functions, loaded when they are first asked for, so that nobody else's start pays for
/// the library and the program runs where it is not installed.
struct EmbreeLibrary {
#define ENCORE_EMBREE_FUNCTIONS(X)     \
  X(rtcNewDevice)                      \
  X(rtcReleaseDevice)                  \
  X(rtcGetDeviceProperty)              \
  X(rtcSetDeviceMemoryMonitorFunction) \
  X(rtcNewScene)                       \
  X(rtcReleaseScene)                   \
  X(rtcSetSceneFlags)                  \
  X(rtcSetSceneBuildQuality)           \
  X(rtcCommitScene)                    \
  X(rtcNewGeometry)                    \
  X(rtcReleaseGeometry)                \
  X(rtcSetGeometryBuildQuality)        \
  X(rtcSetSharedGeometryBuffer)        \
  X(rtcUpdateGeometryBuffer)           \
  X(rtcCommitGeometry)                 \
  X(rtcAttachGeometry)                 \
  X(rtcIntersect1)                     \
  X(rtcIntersect8)                     \
  X(rtcIntersect16)                    \
  X(rtcOccluded1)                      \
  X(rtcOccluded8)                      \
  X(rtcOccluded16)
#define ENCORE_EMBREE_MEMBER(NAME) decltype(&::NAME) NAME = nullptr;
  ENCORE_EMBREE_FUNCTIONS(ENCORE_EMBREE_MEMBER)
#undef ENCORE_EMBREE_MEMBER

  /// Null if it is not there, or lacks a function.
  static const EmbreeLibrary* get();
};

}  // namespace encore::app::bench
