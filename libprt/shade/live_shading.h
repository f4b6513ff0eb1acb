#pragma once
// Exit radiance of the fragments of a LiveView, eight at a time. The same as render.h in other words:
// transferred radiance interpolated over the surface meets the response of the material at the pixel.

#include "libprt/material/glossy_response.h"
#include "libprt/material/material.h"
#include "libprt/shade/live_view.h"
#include "libprt/shade/surface_light.h"

#include <array>
#include <vector>

namespace prt {

/// Light at the samples that a view needs, in the order of LiveView::samples.
class LiveLight {
 public:
  LiveLight() = default;
  LiveLight(const SurfaceLight& light, Job& job);

  TransferForm form() const { return form_; }
  int bands() const { return bands_; }
  /// Three channels after each other, each the functions and zeros up to a multiple of kLiveLanes. The form
  /// None has one record for all.
  const float* radiance(std::uint32_t slot) const {
    return records_.data() + (form_ == TransferForm::None ? 0 : slot) * stride();
  }
  /// Of a white diffuse surface, apart from what `radiance` gives: all of it for the form Diffuse.
  Rgb reflected(std::uint32_t slot) const { return reflected_.empty() ? Rgb(0) : reflected_[slot]; }
  /// Floats per channel.
  std::size_t padded() const { return padded_; }

 private:
  std::size_t stride() const { return 3 * padded_; }

  TransferForm form_ = TransferForm::None;
  int bands_ = 0;
  std::size_t padded_ = 0;
  std::vector<float> records_;
  std::vector<Rgb> reflected_;
};

/// Materials and tables of their lobes.
class LiveMaterials {
 public:
  /// `glossy` false leaves the lobes away. `emission` of each object, or empty: none.
  void set(const std::vector<Material>& materials, int bands, bool glossy,
           const std::vector<Rgb>& emission = {});

  struct Row {
    Rgb albedo{0}, specular{0};
    Rgb emission{0};
    const float* table = nullptr;  ///< [kRows][padded functions], see weightsAt(); null: not glossy
  };
  const Row& operator[](std::uint32_t object) const { return rows_[object]; }
  const std::vector<Vec2>& lobes() const { return lobes_; }

  static constexpr int kRows = 512;  ///< view angles, denser towards the horizon

 private:
  struct Table {
    float exponent;
    int bands;
    std::vector<float> values;
  };
  const Table& tableOf(float exponent, int bands);

  std::vector<Row> rows_;
  std::vector<Table> tables_;
  std::vector<Vec2> lobes_;
};

/// Linear radiance of fragments first .. first + kLiveLanes - 1, not below zero, never NaN. `around` as
/// LiveView::around.
void shadeLive(const LiveTile& tile, int around, std::size_t first, const LiveLight& light,
               const LiveMaterials& materials, std::array<Rgb, kLiveLanes>& radiance);

}  // namespace prt
