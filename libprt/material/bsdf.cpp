#include "libprt/material/bsdf.h"

#include "libprt/core/warp.h"
#include "libprt/material/glossy_response.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

Vec3 mirror(const Vec3& v) {
  return {-v.x, -v.y, v.z};
}
Vec3 flipped(const Vec3& v) {
  return {v.x, v.y, -v.z};
}

bool seenFromBehind(const Material& material, const Vec3& out) {
  return material.twoSided && out.z < 0;
}

/// cos^s of the angle between unit vectors, 0 beyond a right angle. By their distance: s times the rounding
/// error of a dot product is visible at s = 10 000.
float powerCosine(const Vec3& a, const Vec3& b, float s) {
  const Vec3 chord = a - b;
  const float drop = 0.5f * dot(chord, chord);  // 1 - cosine
  return drop < 1 ? std::exp(s * std::log1p(-drop)) : 0.0f;
}

/// Probability of sampling the specular lobe.
float specularShare(const Material& material) {
  if (!material.glossy()) return 0;
  const float diffuse = luminance(material.albedo), specular = luminance(material.specular);
  return specular / (diffuse + specular);
}

bool reflects(const Material& material) {
  return material.glossy() || luminance(material.albedo) > 0;
}

/// A direction about the mirror direction, density (s+1)/(2 pi) cos^s.
Vec3 sampleLobe(const Vec3& axis, float s, const Vec2& u) {
  const float logCosine = std::log1p(-u.y) / (s + 1);
  const float drop = -std::expm1(logCosine);  // 1 - cosine
  const float radius = std::sqrt(std::max(0.0f, drop * (2 - drop)));
  float sine, cosine;
  sinCosTurns(u.x, sine, cosine);
  return normalize(frameFromNormal(axis).toWorld({radius * cosine, radius * sine, 1 - drop}));
}

}  // namespace

Rgb evalBrdf(const Material& material, const Vec3& in, const Vec3& out) {
  if (seenFromBehind(material, out)) return evalBrdf(material, flipped(in), flipped(out));
  if (in.z <= 0 || out.z <= 0) return Rgb(0);
  Rgb f = material.albedo / kPiF;
  if (material.glossy()) {
    const float s = material.exponent;
    f += material.specular * ((s + 2) / (2 * kPiF) * powerCosine(mirror(out), in, s));
  }
  return f;
}

Rgb directionalAlbedo(const Material& material, const Vec3& out) {
  const float cosine = material.twoSided ? std::abs(out.z) : out.z;
  if (cosine <= 0) return Rgb(0);
  Rgb albedo = material.albedo;
  if (material.glossy()) {
    const double angle = std::acos(std::min(1.0, double(cosine)));
    // The first SH function is the constant 1/sqrt(4 pi).
    albedo += material.specular * float(std::sqrt(4 * kPi) * phongResponse(material.exponent, angle, 1)[0]);
  }
  return albedo;
}

BrdfSample sampleBrdf(const Material& material, const Vec3& out, const Vec2& u, float uLobe) {
  if (seenFromBehind(material, out)) {
    BrdfSample sample = sampleBrdf(material, flipped(out), u, uLobe);
    sample.in = flipped(sample.in);
    return sample;
  }
  if (out.z <= 0 || !reflects(material)) return {};
  BrdfSample sample;
  sample.in = uLobe < specularShare(material) ? sampleLobe(mirror(out), material.exponent, u)
                                              : sampleCosineHemisphere(u);
  sample.pdf = pdfBrdf(material, sample.in, out);
  if (sample.pdf > 0 && sample.in.z > 0)
    sample.weight = evalBrdf(material, sample.in, out) * (sample.in.z / sample.pdf);
  return sample;
}

float pdfBrdf(const Material& material, const Vec3& in, const Vec3& out) {
  if (seenFromBehind(material, out)) return pdfBrdf(material, flipped(in), flipped(out));
  if (out.z <= 0 || !reflects(material)) return 0;
  const float share = specularShare(material);
  float pdf = (1 - share) * pdfCosineHemisphere(in);
  if (share > 0) {
    const float s = material.exponent;
    pdf += share * (s + 1) / (2 * kPiF) * powerCosine(mirror(out), in, s);
  }
  return pdf;
}

}  // namespace prt
