// Project files whose bytes have been changed. An input is a list of changes to a small sound project, so
// that it is short although the file is not: one byte chooses the file (the project, the working copy of a
// killed bake, or that copy's journal), then come changes of four bytes place, one byte count and the new
// bytes. Places count the bytes that are not zero, as most of a file's pages are empty.

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/project/project_file.h"
#include "tests/fuzz/target.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <numeric>

namespace {

using namespace prt;
using fuzz::require;
namespace fs = std::filesystem;

using Bytes = std::vector<std::byte>;

void write(const fs::path& file, const Bytes& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

Array ramp(std::int64_t count) {
  std::vector<float> values(std::size_t(count), 0.0f);
  std::iota(values.begin(), values.end(), 0.0f);
  return Array::from<float>(std::span<const float>(values), {count});
}

/// What a reader gets of a project.
struct Contents {
  Recipe recipe;
  std::map<std::string, std::map<std::string, std::vector<std::byte>>> products;
  bool operator==(const Contents&) const = default;
};

Contents contentsOf(ProjectFile& project) {
  Contents contents;
  contents.recipe = project.recipe();
  for (const ProductInfo& info : project.contents()) {
    const auto checkpoint = info.checkpoint ? project.findCheckpoint(info.stage, info.key) : nullptr;
    const auto product = info.checkpoint ? nullptr : project.find(info.stage, info.key);
    if (!checkpoint && !product) continue;  // damaged in a working copy: counts as not there
    auto& arrays =
        contents
            .products[info.stage + " " + info.key + " " + info.meta + (info.checkpoint ? " checkpoint" : "")];
    for (const auto& [name, array] : checkpoint ? checkpoint->arrays : product->data.arrays)
      arrays[name] = array.bytes;
  }
  return contents;
}

/// Nothing that the whole has not; less where something was damaged.
bool isPart(const Contents& part, const Contents& whole) {
  return part.recipe == whole.recipe && std::ranges::all_of(part.products, [&](const auto& product) {
           const auto found = whole.products.find(product.first);
           return found != whole.products.end() && found->second == product.second;
         });
}

/// The files that are changed, and places in them that hold something.
struct Ground {
  test::TemporaryFolder folder;
  fs::path file = folder / "p.prt", work = ProjectFile::workFile(file);
  Bytes project, copy, journal;
  Contents contents, workContents;

  Ground() {
    {
      const auto made = ProjectFile::openForWork(file);
      made->put("mesh", "k1", {{R"({"objects":[{}]})", {{"a", ramp(100)}, {"b", ramp(0)}}}, 1, 1});
      made->putCheckpoint("direct", "k2", {"{}", {{"sums", ramp(3000)}}});
      made->putSourceHash("a.obj", "hash");
      made->save();
      contents = contentsOf(*made);
    }
    project = readFile(file);
    {
      const auto bake = ProjectFile::openForWork(file);
      bake->put("direct", "k3", {{"{}", {{"c", ramp(200)}}}, 1, 2});
      workContents = contentsOf(*bake);
    }
    copy = readFile(work);
    // A journal as SQLite begins one: its magic number, one page, and a page's worth of the copy.
    journal = Bytes(512 + 4 + 65536 + 4);
    const unsigned char head[28] = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7, 0, 0, 0, 1, 0, 0,
                                    0,    0,    0,    0,    0,    9,    0,    0,    2, 0, 0, 1, 0, 0};
    std::memcpy(journal.data(), head, sizeof head);
    std::memcpy(journal.data() + 516, copy.data() + 65536, 65536);
    journal[515] = std::byte(2);
    fs::remove(work);
  }
};

std::vector<std::uint32_t> placesIn(const Bytes& bytes) {
  std::vector<std::uint32_t> places;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (bytes[i] != std::byte(0) || i < 128) places.push_back(std::uint32_t(i));
  return places;
}

Bytes changed(Bytes bytes, const std::uint8_t* data, std::size_t size) {
  const std::vector<std::uint32_t> places = placesIn(bytes);
  while (size >= 5) {
    std::uint32_t place;
    std::memcpy(&place, data, 4);
    const std::size_t count = std::min<std::size_t>(data[4], size - 5);
    if (place >= 0xfffffff0u) {
      bytes.resize(bytes.size() * (place & 15) / 16);  // the end is missing
    } else {
      const std::size_t at = places[place % places.size()];
      for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i) bytes[at + i] = std::byte(data[5 + i]);
    }
    data += 5 + count;
    size -= 5 + count;
  }
  return bytes;
}

template <class Action>
bool succeeds(Action action) {
  try {
    action();
    return true;
  } catch (const Error& error) {
    require(std::strchr(error.what(), '\n') == nullptr);
    return false;
  }
}

/// Whatever opens and verifies holds what was saved.
void readChanged(const Ground& ground, const Bytes& bytes) {
  write(ground.file, bytes);
  Contents contents;
  const bool read = succeeds([&] { contents = contentsOf(*ProjectFile::open(ground.file)); });
  Job job;
  const bool verified = succeeds([&] { ProjectFile::verify(ground.file, job); });
  if (read) require(contents == ground.contents);
  if (verified) require(read);
  write(ground.file, ground.project);
}

/// Work that was left behind is gone on with as far as it is sound, else begun anew; the saved project stays
/// as it is.
void resumeChanged(const Ground& ground, const Bytes& copy, const Bytes& journal) {
  write(ground.work, copy);
  if (!journal.empty()) write(ground.work.string() + "-journal", journal);
  succeeds([&] {
    const auto project = ProjectFile::openForWork(ground.file);
    Contents contents;
    if (succeeds([&] { contents = contentsOf(*project); }))
      require(isPart(contents, ground.contents) || isPart(contents, ground.workContents));
  });
  require(readFile(ground.file) == ground.project);
  fs::remove(ground.work);
  fs::remove(ground.work.string() + "-journal");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Ground ground;
  if (size == 0) return 0;
  switch (data[0] % 4) {
    case 0:
    case 1:
      readChanged(ground, changed(ground.project, data + 1, size - 1));
      break;
    case 2:
      resumeChanged(ground, changed(ground.copy, data + 1, size - 1), {});
      break;
    default:
      resumeChanged(ground, ground.copy, changed(ground.journal, data + 1, size - 1));
      break;
  }
  return 0;
}

const prt::fuzz::Target prt::fuzz::target{
    .name = "project",
    .seeds =
        [] {
          std::vector<std::string> seeds;
          for (int i = 0; i < 64; ++i) {
            std::string seed(1, char(i));
            for (int change = 0; change <= i % 3; ++change) {
              const std::uint32_t place = std::uint32_t(i * 2654435761u + unsigned(change) * 40503u);
              seed.append(reinterpret_cast<const char*>(&place), 4);
              seed += char(1 + i % 4);
              seed.append(std::size_t(1 + i % 4), char(i * 37));
            }
            seeds.push_back(seed);
          }
          return seeds;
        },
    .words = {std::string("\xf8\xff\xff\xff\0", 5), std::string("\1\0\0\0\1\xff", 6),
              std::string("\x1c\0\0\0\4\xff\xff\xff\xff", 9), std::string("\x10\0\0\0\2\1\0", 7)},
    .runs = 1500,
    .memoryBase = std::size_t{200} << 20};
