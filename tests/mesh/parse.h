#pragma once
// Parsers called on text, for tests.

#include "libprt/core/error.h"
#include "libprt/mesh/mesh_reader.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace prt::test {

using MeshParser = PolygonSoup (*)(std::string_view, const MeshSource&, Job&);

inline PolygonSoup parsed(MeshParser parser, std::string_view bytes,
                          const std::filesystem::path& folder = {}) {
  Job job;
  return parser(bytes, {"test file", folder}, job);
}

/// The message of the FileError that parsing ends in; empty, with a failure, when there is none.
inline std::string refusal(MeshParser parser, std::string_view bytes,
                           const std::filesystem::path& folder = {}) {
  try {
    parsed(parser, bytes, folder);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find("test file"), 0u) << "says where: " << error.what();
    EXPECT_FALSE(error.fix().empty()) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "was accepted: " << bytes.substr(0, 200);
  return {};
}

/// The bytes of a number in the machine's order.
template <class T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

}  // namespace prt::test
