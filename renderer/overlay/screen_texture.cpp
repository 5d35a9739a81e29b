#include "renderer/overlay/screen_texture.h"

#include "renderer/gl/error.h"
#include "renderer/image_io.h"
#include "renderer/portable_power.h"

#include <array>
#include <bit>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace encore::renderer {

namespace {

// Floats of a bucket share exponent and the first seven bits of the fraction, so that at most one
// code ends inside it: it is 2^-8 of the next power of two wide, and codes are closest together
// just below 1, by 1 / 112, and by more relative to it further down.
constexpr int kShift = 23 - 7;
constexpr std::uint32_t kRest = (1U << kShift) - 1;
constexpr std::uint32_t kFirstBits = std::bit_cast<std::uint32_t>(0x1p-13F);  // far within code 0
constexpr std::uint32_t kLastBits = std::bit_cast<std::uint32_t>(1.0F);
constexpr std::size_t kBuckets = ((kLastBits - kFirstBits) >> kShift) + 1;

/// The bits of the first float between two that has a code above that of `first`.
std::uint32_t first_above(std::uint32_t first, std::uint32_t last) {
  const std::uint8_t code = to_srgb8(std::bit_cast<float>(first));
  while (last - first > 1) {
    const std::uint32_t middle = first + (last - first) / 2;
    (to_srgb8(std::bit_cast<float>(middle)) > code ? last : first) = middle;
  }
  return last;
}

/// For each bucket its first code in the upper half; in the lower, what makes the rest of a float's
/// bits, added, carry over into it from where the code is one more.
using Buckets = std::array<std::uint32_t, kBuckets>;

Buckets make_buckets() {
  Buckets buckets{};
  for (std::size_t i = 0; i < kBuckets; ++i) {
    const std::uint32_t first = kFirstBits + (static_cast<std::uint32_t>(i) << kShift);
    const std::uint32_t last = first + kRest;
    const std::uint8_t code = to_srgb8(std::bit_cast<float>(first));
    const bool grows = to_srgb8(std::bit_cast<float>(last)) > code;
    const std::uint32_t carry = grows ? kRest + 1 - (first_above(first, last) - first) : 0;
    buckets[i] = (std::uint32_t{code} << kShift) + carry;
  }
  return buckets;
}

std::array<float, 256> make_decoded() {
  std::array<float, 256> decoded{};
  for (int code = 0; code < 256; ++code) {
    const double encoded = code / 255.0;
    decoded[static_cast<std::size_t>(code)] = static_cast<float>(
        encoded <= 0.04045 ? encoded / 12.92 : portable_power((encoded + 0.055) / 1.055, 2.4));
  }
  return decoded;
}

std::uint8_t code_of(const Buckets& buckets, float linear) {
  // In this order a value that is not a number becomes the smallest.
  const float low = linear > 0x1p-13F ? linear : 0x1p-13F;
  const auto bits = std::bit_cast<std::uint32_t>(low < 1.0F ? low : 1.0F);
  const std::uint32_t bucket = buckets[(bits - kFirstBits) >> kShift];
  return static_cast<std::uint8_t>((bucket + (bits & kRest)) >> kShift);
}

}  // namespace

void picture_to_rgba8(const Image& picture, std::span<std::uint8_t> rgba) {
  static const Buckets kTable = make_buckets();
  if (rgba.size() != 4 * picture.pixels.size()) {
    throw std::invalid_argument("a picture of " + std::to_string(picture.pixels.size()) +
                                " pixels needs four bytes for each, not " +
                                std::to_string(rgba.size()) + " in all");
  }
  std::uint8_t* out = rgba.data();
  for (const glm::vec3& pixel : picture.pixels) {
    out[0] = code_of(kTable, pixel.r);
    out[1] = code_of(kTable, pixel.g);
    out[2] = code_of(kTable, pixel.b);
    out[3] = 255;
    out += 4;
  }
}

float srgb8_to_linear(std::uint8_t code) {
  static const std::array<float, 256> kDecoded = make_decoded();
  return kDecoded[code];
}

ScreenTexture::ScreenTexture(std::shared_ptr<gl::Context> context)
    : context_(gl::made_current(std::move(context))) {}

ScreenTexture::~ScreenTexture() {
  try {
    context_->make_current();  // the texture is this context's
  } catch (const gl::GlError&) {
    // It went with the context.
  }
}

void ScreenTexture::upload(std::span<const std::uint8_t> rgba, int width, int height) {
  static const std::string doing = "sending a picture to the window";
  context_->make_current();
  texture_.resize(width, height, context_->capabilities().texture_size);
  texture_.write(rgba);
  context_->check(doing);
}

}  // namespace encore::renderer
