#pragma once
// From direct transfer to the finished product: bounces, form, storage. The second of the two products of a
// transfer bake; it depends on the direct product and the albedos.
//
// Bounces (Neumann gather, ALGORITHMS 3.2): e_{k+1} = (1/pi) integral over the rays that hit of
// albedo * e_k at the hit point * cosine, e_k interpolated between the vertices of the triangle that was hit,
// or between the texels around the point.
// Glossy surfaces reflect diffusely in bounces: only their albedo counts there, not their specular part.
// Back faces block and reflect nothing, unless the material is two-sided: then the sample on the vertex's
// back answers. For the Matrix form the last bounce keeps the direction that light comes from.

#include "libprt/transport/direct_transfer.h"
#include "libprt/transport/transfer.h"

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

namespace prt {

struct TransferSettings {
  std::optional<TransferForm> form;  ///< empty: the cheapest that holds what the materials need
  int bands = 5;                     ///< 1..10; n bands are n^2 functions of light
  int rays = 4096;                   ///< per sample; the error falls about as rays^-0.75
  int bounces = 3;                   ///< 0 = shadows only; at most kMaxBounces
  bool shadows = true;               ///< false = nothing is baked, light arrives unchanged
  float stopThreshold = 1e-3f;   ///< end when a bounce adds less than this share of what is there; 0 = never
  bool areaMeans = true;         ///< bounces leave from means around vertices (area_means.h), not bare values
  std::optional<DType> storage;  ///< f16 or f32; empty: f16 for matrices, else f32
  std::uint64_t seed = 1;
  std::size_t hitMemory = std::size_t{1} << 30;  ///< bytes for remembering hits; changes speed only
};

inline constexpr int kMaxBounces = 100;

/// Throws ValueError when a setting is out of range or the form cannot hold what is asked for (bounces in
/// the Visibility form).
void check(const TransferSettings& settings);

/// The form that will be baked: None without shadows; else as set; else Diffuse for Lambert materials only,
/// Visibility for glossy ones without bounces, Matrix for the rest.
TransferForm resolveForm(const TransferSettings& settings, std::span<const Material> materials);

/// Settings of the direct product that a form other than None needs.
DirectSettings directSettings(const TransferSettings& settings, TransferForm form);

/// What bouncing between the vertices has come to after a bounce, as named arrays. A run that is given an
/// earlier one's state goes on from there, to the same bits.
struct BounceCheckpoint {
  std::map<std::string, Array> saved;  ///< where an earlier run was; what does not fit is left alone
  std::function<void(std::map<std::string, Array>)> keep;  ///< gets the state after every bounce
};

/// Everything after the direct product. `samples` are those of `direct`. When they are the scene's vertices
/// or the texels of its charts, `surface` may be null. For other sets it must be a finished Transfer of the
/// same scene's vertices, or of `surfaceSamples` (its texels), with the same number of bounces: light bounces
/// between those, and any point gathers from them. `checkpoint` serves their own bounces. For the form None
/// `direct` is ignored. Throws ValueError when the parts do not fit.
Transfer finishTransfer(const Scene& scene, const RayScene& rays, const SampleSet& samples,
                        const DirectTransfer& direct, const TransferSettings& settings, TransferForm form,
                        Job& job, const Transfer* surface = nullptr,
                        const BounceCheckpoint* checkpoint = nullptr,
                        const SampleSet* surfaceSamples = nullptr);

/// The whole bake. `preview`, if given, gets every level but the last as it is completed.
Transfer bakeTransfer(std::shared_ptr<const Scene> scene, std::shared_ptr<const RayScene> rays,
                      std::shared_ptr<const SampleSet> samples, const TransferSettings& settings, Job& job,
                      const std::function<void(Transfer)>& preview = {});

}  // namespace prt
