#pragma once
#include <cmath>
#include <cstdint>

namespace placegraph::synthetic {

/// Basic functions of all procedural textures. They use only integer arithmetic and + - * / on
/// floats, no libm, so that the same seed gives the same bits on every machine.

/// Largest integer not above `x`; |x| < 2^31.
inline int floor_int(double x) {
  const int i = static_cast<int>(x);
  return i - (x < i);
}

/// Mixes 32 bits (a finalizer of the murmur family).
inline std::uint32_t mix_bits(std::uint32_t h) {
  h ^= h >> 16;
  h *= 0x7feb352dU;
  h ^= h >> 15;
  h *= 0x846ca68bU;
  h ^= h >> 16;
  return h;
}

/// A hash of two integers and a seed.
inline std::uint32_t hash_cell(int x, int y, std::uint32_t seed) {
  return mix_bits(static_cast<std::uint32_t>(x) * 0x9e3779b1U +
                  static_cast<std::uint32_t>(y) * 0x85ebca77U + seed * 0xc2b2ae3dU);
}

/// A number in [0, 1) from a hash; `salt` gives several independent ones.
inline float hash_unit(std::uint32_t h, std::uint32_t salt = 0) {
  if (salt) h = mix_bits(h + salt * 0x9e3779b9U);
  return static_cast<float>(h >> 8) * (1.0F / 16777216.0F);
}

/// Approximately normal with sigma 1: four uniform bytes of one hash, whose sum has sigma 147.8.
inline float hash_normal(std::uint32_t h) {
  const auto sum = (h & 255U) + (h >> 8 & 255U) + (h >> 16 & 255U) + (h >> 24);
  return (static_cast<float>(sum) - 510.0F) * (1.0F / 147.80F);
}

inline float clamp01(float x) { return x < 0 ? 0 : (x > 1 ? 1 : x); }
inline float mix(float a, float b, float amount) { return a + (b - a) * amount; }

/// Value noise in [-1, 1] on the unit lattice (Perlin's fade curve, smoothstep form).
inline float value_noise(double x, double y, std::uint32_t seed) {
  const int ix = floor_int(x), iy = floor_int(y);
  float fx = static_cast<float>(x - ix), fy = static_cast<float>(y - iy);
  fx = fx * fx * (3 - 2 * fx);
  fy = fy * fy * (3 - 2 * fy);
  const std::uint32_t base = static_cast<std::uint32_t>(ix) * 0x9e3779b1U +
                             static_cast<std::uint32_t>(iy) * 0x85ebca77U + seed * 0xc2b2ae3dU;
  const auto corner = [](std::uint32_t h) {
    h ^= h >> 15;  // the products with x and y have mixed the bits once already
    h *= 0x846ca68bU;
    return static_cast<float>(static_cast<std::int32_t>(h)) * (1.0F / 2147483648.0F);
  };
  const float a = corner(base), b = corner(base + 0x9e3779b1U), c = corner(base + 0x85ebca77U),
              d = corner(base + 0x9e3779b1U + 0x85ebca77U);
  const float top = a + (b - a) * fx, bottom = c + (d - c) * fx;
  return top + (bottom - top) * fy;
}

/// The part of a box of width `w` around `x` that lies in [lo, hi]: an antialiased interval.
inline float pulse(float x, float lo, float hi, float w) {
  const float a = x - 0.5F * w > lo ? x - 0.5F * w : lo;
  const float b = x + 0.5F * w < hi ? x + 0.5F * w : hi;
  return b > a ? (b - a) / w : 0;
}

/// The part of a box of width `w` around `x` covered by [lo, hi] repeated with `period` (0 <= lo <=
/// hi <= period): stripes that fade to grey with distance, without moire.
inline float periodic_pulse(double x, float period, float lo, float hi, float w) {
  const auto integral = [&](double at) {
    const int n = floor_int(at / period);
    const float r = static_cast<float>(at - static_cast<double>(n) * period);
    const float in = r < lo ? 0 : (r > hi ? hi - lo : r - lo);
    return static_cast<double>(n) * (hi - lo) + in;
  };
  return static_cast<float>(integral(x + 0.5 * w) - integral(x - 0.5 * w)) / w;
}

/// A disc of radius `r` around the origin seen at (x, y) through a footprint `w`: 1 inside, 0
/// outside, a ramp of width `w` between.
inline float disc(float x, float y, float r, float w) {
  return clamp01((r - std::sqrt(x * x + y * y)) / (w > 1e-6F ? w : 1e-6F) + 0.5F);
}

}  // namespace placegraph::synthetic
