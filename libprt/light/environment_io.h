#pragma once
// Environment maps from files.

#include "libprt/light/environment.h"

#include <filesystem>
#include <optional>

namespace prt {

/// The mapping that an image most likely holds: by its shape; crosses and angular maps also by what lies
/// outside the mapping, which must be of one colour but for labels. Nothing when no mapping fits.
std::optional<EnvironmentMapping> detectMapping(const Image& image);

/// Reads an image of any format that readImage() takes. Without `mapping` it is detected. Throws FileError
/// when the file cannot be read, or no mapping fits, saying what would.
EnvironmentMap loadEnvironment(const std::filesystem::path& path,
                               std::optional<EnvironmentMapping> mapping = {});

/// The same from an image; `source` is what errors and the report call it.
EnvironmentMap makeEnvironment(const Image& image, const std::string& source,
                               std::optional<EnvironmentMapping> mapping = {});

}  // namespace prt
