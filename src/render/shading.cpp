#include "render/shading.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pdc::detail {
namespace {

constexpr Vec3f kClayColor{0.64F, 0.58F, 0.50F};
constexpr Vec3f kBackFaceColor{0.60F, 0.16F, 0.10F};
constexpr Vec3f kBackground{0.93F, 0.93F, 0.91F};
/// The direction to the lamp, which stands to the left above the viewer's shoulder.
constexpr Vec3f kLamp{-0.48F, 0.60F, 0.64F};

/// A weak lamp stands to the right, or what the first does not reach would all look alike.
constexpr Vec3f kSecondLamp{0.80F, 0.10F, 0.59F};
constexpr float kSecondShare = 0.18F;

/// Lightness rises evenly from the first colour to the last, so that order survives in grey and for any colour vision.
constexpr std::array<Vec3f, 5> kValueColors{{{0.030F, 0.020F, 0.120F},
                                             {0.030F, 0.110F, 0.260F},
                                             {0.020F, 0.270F, 0.250F},
                                             {0.260F, 0.520F, 0.110F},
                                             {0.950F, 0.850F, 0.150F}}};

Vec3f product(const Vec3f& a, const Vec3f& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

}  // namespace

Vec3f backgroundColor() { return kBackground; }

Vec3f valueColor(float share) {
  constexpr Vec3f kUnknown{0.3F, 0.3F, 0.3F};
  if (std::isnan(share)) return kUnknown;
  const float place = std::clamp(share, 0.0F, 1.0F) * static_cast<float>(kValueColors.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), kValueColors.size() - 2);
  const float t = place - static_cast<float>(low);
  return kValueColors[low] * (1 - t) + kValueColors[low + 1] * t;
}

Vec3f surfaceColor(Shading shading, const Vec3f& normal, float share, bool backFace, float open) {
  const float lamp = std::max(0.0F, dot(normal, kLamp)) + kSecondShare * std::max(0.0F, dot(normal, kSecondLamp));
  const float sky = 0.5F + 0.5F * normal.y;
  if (shading == Shading::kNormal && !backFace) {
    const Vec3f turned = normal * 0.5F + Vec3f{0.5F, 0.5F, 0.5F};
    return product(turned, turned) * (0.25F + 0.75F * open);
  }
  const Vec3f base = backFace ? kBackFaceColor : shading == Shading::kValues ? valueColor(share) : kClayColor;
  // Values are read off the colours, so light changes those less.
  const float ambient = shading == Shading::kValues ? 0.55F : 0.30F;
  const float light = open * (ambient * (0.6F + 0.4F * sky) + (1.15F - ambient) * lamp);
  return base * light;
}

std::uint8_t toByte(float linear) {
  return static_cast<std::uint8_t>(std::sqrt(std::clamp(linear, 0.0F, 1.0F)) * 255 + 0.5F);
}

}  // namespace pdc::detail
