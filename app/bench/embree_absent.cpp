#if !defined(ENCORE_HAVE_EMBREE)

#include "app/bench/embree.h"

#include <stdexcept>

namespace encore::app::bench {

struct EmbreeDevice::Handles {};
struct EmbreeScene::Handles {};

namespace {
[[noreturn]] void absent() {
  throw std::logic_error("this program was built without Embree");
}
}  // namespace

EmbreeDevice::EmbreeDevice(std::unique_ptr<Handles> handles) : handles_(std::move(handles)) {}
EmbreeDevice::~EmbreeDevice() = default;
std::unique_ptr<EmbreeDevice> EmbreeDevice::open(int) {
  return nullptr;
}
std::string EmbreeDevice::version() const {
  return {};
}
std::uint64_t EmbreeDevice::bytes() const {
  return 0;
}
std::uint64_t EmbreeDevice::peak_bytes() const {
  return 0;
}
void EmbreeDevice::forget_peak() {}

EmbreeScene::EmbreeScene(EmbreeDevice&, const EmbreeSettings&) {
  absent();
}
EmbreeScene::~EmbreeScene() = default;
void EmbreeScene::build(std::span<const scene::Triangle>) {}
void EmbreeScene::refit(std::span<const scene::Triangle>) {}
void EmbreeScene::intersect(std::span<const scene::Ray>, std::span<scene::Hit>) const {}
void EmbreeScene::occluded(std::span<const scene::Ray>, std::span<std::uint8_t>) const {}
void EmbreeScene::trace(const EmbreeRays&, EmbreePackets, std::size_t, std::size_t,
                        std::span<HitPacket>) const {}
void EmbreeScene::trace(const RayPacket&, HitPacket&) const {}

}  // namespace encore::app::bench

#endif
