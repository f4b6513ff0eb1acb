#pragma once
// Warps from the unit square to directions and shapes: for each its density and its inverse, side by side.
// Directions are about +z; densities are per solid angle (disc: per area of the unit disc) and 0 outside.
// inverse(sample(u)) = u. All code is free of data-dependent branches, so loops over arrays vectorise.

#include "libprt/core/math.h"

#include <algorithm>

namespace prt {

/// Sine and cosine of 2 pi * turns, |turns| < 2^20; error below 2e-7.
inline void sinCosTurns(float turns, float& sine, float& cosine) {
  const float quarter = std::floor(4 * turns + 0.5f);
  const float x = (turns - 0.25f * quarter) * (2 * kPiF);  // within +-pi/4
  const float x2 = x * x;
  const float s = x + x * x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040 + x2 * (1.0f / 362880))));
  const float c = 1 + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 * (1.0f / 40320))));
  const int q = int(quarter);
  const float sineSide = (q & 1) ? c : s, cosineSide = (q & 1) ? s : c;
  sine = (q & 2) ? -sineSide : sineSide;
  cosine = ((q + 1) & 2) ? -cosineSide : cosineSide;
}

/// Angle of (x, y) in turns, in [0, 1).
inline float turnsOf(float x, float y) {
  const float turns = std::atan2(y, x) * (0.5f / kPiF);
  return std::min(turns < 0 ? turns + 1 : turns, 0x1.fffffep-1f);
}

// --- Uniform on a cone (spherical cap) about +z -----------------------------------------------------
// A cone is given by its height h = 1 - cos(half angle), which stays accurate where the cosine does not:
// the sun's is 1.1e-5. Its solid angle is 2 pi h; h = 1 is the hemisphere, h = 2 the sphere.

inline float coneHeight(float halfAngle) {
  const float s = std::sin(0.5f * halfAngle);
  return 2 * s * s;
}

inline Vec3 sampleUniformCone(const Vec2& u, float height) {
  const float below = u.y * height;  // 1 - z
  const float radius = std::sqrt(std::max(0.0f, below * (2 - below)));
  float sine, cosine;
  sinCosTurns(u.x, sine, cosine);
  return {radius * cosine, radius * sine, 1 - below};
}

/// 1 - z of a unit direction, without cancellation near the pole.
inline float belowPole(const Vec3& d) {
  return d.z > 0 ? (d.x * d.x + d.y * d.y) / (1 + d.z) : 1 - d.z;
}

inline float pdfUniformCone(const Vec3& d, float height) {
  return belowPole(d) <= height ? 1 / (2 * kPiF * height) : 0.0f;
}

inline Vec2 inverseUniformCone(const Vec3& d, float height) {
  return {turnsOf(d.x, d.y), std::min(belowPole(d) / height, 1.0f)};
}

// --- Uniform on the sphere and on the upper hemisphere ---------------------------------------------------

inline Vec3 sampleUniformSphere(const Vec2& u) {
  return sampleUniformCone(u, 2);
}
inline float pdfUniformSphere() {
  return 1 / (4 * kPiF);
}
inline Vec2 inverseUniformSphere(const Vec3& d) {
  return inverseUniformCone(d, 2);
}

inline Vec3 sampleUniformHemisphere(const Vec2& u) {
  return sampleUniformCone(u, 1);
}
inline float pdfUniformHemisphere(const Vec3& d) {
  return d.z >= 0 ? 1 / (2 * kPiF) : 0.0f;
}
inline Vec2 inverseUniformHemisphere(const Vec3& d) {
  return inverseUniformCone(d, 1);
}

// --- Uniform on the unit disc: concentric map (Shirley and Chiu 1997) ------------------------------------

inline Vec2 sampleConcentricDisc(const Vec2& u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  const bool wide = std::abs(a) > std::abs(b);
  const float radius = wide ? a : b, other = wide ? b : a;
  float sine, cosine;  // of the angle to the axis that the sector lies on
  sinCosTurns(radius != 0 ? 0.125f * other / radius : 0.0f, sine, cosine);
  return radius * (wide ? Vec2(cosine, sine) : Vec2(sine, cosine));
}

inline float pdfConcentricDisc(const Vec2& p) {
  return p.x * p.x + p.y * p.y <= 1 ? 1 / kPiF : 0.0f;
}

inline Vec2 inverseConcentricDisc(const Vec2& p) {
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float major = wide ? p.x : p.y, minor = wide ? p.y : p.x;
  const float radius = std::copysign(std::sqrt(p.x * p.x + p.y * p.y), major);
  const float other = major != 0 ? radius * std::atan(minor / major) * (4 / kPiF) : 0.0f;
  return 0.5f * (wide ? Vec2(radius, other) : Vec2(other, radius)) + 0.5f;
}

// --- Proportional to the cosine on the upper hemisphere ---------------------------------------------------

inline Vec3 sampleCosineHemisphere(const Vec2& u) {
  const Vec2 p = sampleConcentricDisc(u);
  return {p.x, p.y, std::sqrt(std::max(0.0f, 1 - p.x * p.x - p.y * p.y))};
}

inline float pdfCosineHemisphere(const Vec3& d) {
  return std::max(0.0f, d.z) / kPiF;
}
inline Vec2 inverseCosineHemisphere(const Vec3& d) {
  return inverseConcentricDisc({d.x, d.y});
}

// --- Uniform on a triangle (Heitz 2019, "A Low-Distortion Map Between Triangle and Square") --------------
// As barycentric weights of corners 1 and 2; corner 0 has 1 - x - y.

inline Vec2 sampleTriangle(const Vec2& u) {
  return u.y > u.x ? Vec2(0.5f * u.x, u.y - 0.5f * u.x) : Vec2(u.x - 0.5f * u.y, 0.5f * u.y);
}

/// Per area; the same everywhere inside.
inline float pdfTriangle(float area) {
  return 1 / area;
}

inline Vec2 inverseTriangle(const Vec2& b) {
  return b.y > b.x ? Vec2(2 * b.x, b.x + b.y) : Vec2(b.x + b.y, 2 * b.y);
}

}  // namespace prt
