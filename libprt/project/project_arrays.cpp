// Arrays in a project file: cut into chunks, compressed, each with its checksum.

#include "libprt/core/hash.h"
#include "libprt/project/project_schema.h"

#include <zstd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>
#include <stdexcept>

namespace prt {
namespace {

constexpr int kLevel = 1;  // float data gains little from higher levels

[[noreturn]] void damaged(Database& database, const std::string& what) {
  throw DamagedFile("is damaged: " + what, database.file().string(), "use a backup or bake again");
}

std::string checksumOf(std::span<const std::byte> bytes) {
  return hashBytes(bytes).hex();
}

std::string shapeText(const std::vector<std::int64_t>& shape) {
  return nlohmann::json(shape).dump();
}

/// What an array's checksum covers; one line a chunk follows.
std::string arrayHead(const std::string& name, const std::string& dtype, const std::string& shape) {
  return name + "\n" + dtype + "\n" + shape + "\n";
}

std::string chunkLine(std::int64_t bytes, const std::string& checksum) {
  return std::to_string(bytes) + " " + checksum + "\n";
}

/// Bytes of an array of this shape, or -1 when that is not a sensible number.
std::int64_t byteCount(const std::vector<std::int64_t>& shape, DType dtype) {
  std::int64_t count = std::int64_t(sizeOf(dtype));
  for (const std::int64_t extent : shape) {
    if (extent < 0 || (extent > 0 && count > (std::int64_t(1) << 46) / extent)) return -1;
    count *= extent;
  }
  return count;
}

std::vector<std::byte> compress(std::span<const std::byte> bytes) {
  std::vector<std::byte> packed(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size))
    throw ResourceError(std::string("compression failed: ") + ZSTD_getErrorName(size), "",
                        "free some memory");
  packed.resize(size);
  return packed;
}

ArrayInfo readArrayRow(Database& database, Statement& row) {
  ArrayInfo info;
  const std::int64_t id = row.integer(0);
  info.name = row.text(1);
  const std::string dtype = row.text(2), shape = row.text(3);
  info.checksum = row.text(4);
  const std::string what = "array '" + info.name + "'";
  std::string covered = arrayHead(info.name, dtype, shape);
  Statement chunks(database,
                   "SELECT number, bytes, checksum, length(data) FROM chunk WHERE array = ? ORDER BY number");
  chunks.bind(id);
  for (std::int64_t number = 0; chunks.step(); ++number) {
    if (chunks.integer(0) != number) damaged(database, what + " lacks a chunk");
    if (chunks.integer(1) < 0 || chunks.integer(1) > std::int64_t(kChunkBytes))
      damaged(database, what + " has a wrong chunk");
    info.bytes += chunks.integer(1);
    info.stored += chunks.integer(3);
    covered += chunkLine(chunks.integer(1), chunks.text(2));
  }
  if (checksumOf(std::as_bytes(std::span(covered))) != info.checksum)
    damaged(database, what + " has changed");
  try {
    info.dtype = dtypeFromString(dtype);
    info.shape = nlohmann::json::parse(shape).get<std::vector<std::int64_t>>();
  } catch (const std::exception&) {
    damaged(database, what + " has no type or shape");
  }
  if (byteCount(info.shape, info.dtype) != info.bytes) damaged(database, what + " is not of its size");
  return info;
}

}  // namespace

std::vector<ProductRow> readProductRows(Database& database) {
  std::vector<ProductRow> rows;
  Statement products(
      database,
      "SELECT id, stage, key, role, level, levels, meta, checksum FROM product ORDER BY stage, key, role");
  while (products.step()) {
    ProductRow row{products.integer(0), products.text(3), {}};
    ProductInfo& info = row.info;
    info = {products.text(1),
            products.text(2),
            row.role == kCheckpoint,
            int(products.integer(4)),
            int(products.integer(5)),
            products.text(6),
            {}};
    Statement arrays(database,
                     "SELECT id, name, dtype, shape, checksum FROM array WHERE product = ? ORDER BY name");
    arrays.bind(row.id);
    while (arrays.step()) info.arrays.push_back(readArrayRow(database, arrays));
    if (productChecksum(info, row.role) != products.text(7))
      damaged(database, "the " + row.role + " of stage " + info.stage + " has changed");
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string writeArray(Database& database, std::int64_t product, const std::string& name, const Array& array,
                       std::size_t& uncommitted, const std::function<void()>& check) {
  if (byteCount(array.shape, array.dtype) != std::int64_t(array.bytes.size()))
    throw std::logic_error("array '" + name + "' does not have as many bytes as its shape says");
  const std::string dtype = toString(array.dtype), shape = shapeText(array.shape);
  std::string covered = arrayHead(name, dtype, shape);
  const std::int64_t id = nextArrayId(database);
  Statement insert(database, "INSERT INTO chunk(array, number, bytes, checksum, data) VALUES(?, ?, ?, ?, ?)");
  const std::span<const std::byte> all(array.bytes);
  for (std::size_t begin = 0, number = 0; begin < all.size(); begin += kChunkBytes, ++number) {
    if (check) check();
    const auto raw = all.subspan(begin, std::min(kChunkBytes, all.size() - begin));
    const std::vector<std::byte> packed = compress(raw);
    const std::string checksum = checksumOf(packed);
    insert.bind(id)
        .bind(std::int64_t(number))
        .bind(std::int64_t(raw.size()))
        .bind(checksum)
        .bind(std::span(packed))
        .run();
    covered += chunkLine(std::int64_t(raw.size()), checksum);
    uncommitted += packed.size();
    if (uncommitted >= kCommitBytes) {
      database.execute("COMMIT");
      database.execute("BEGIN IMMEDIATE");
      uncommitted = 0;
    }
  }
  const std::string checksum = checksumOf(std::as_bytes(std::span(covered)));
  Statement row(database,
                "INSERT INTO array(id, product, name, dtype, shape, checksum) VALUES(?, ?, ?, ?, ?, ?)");
  row.bind(id).bind(product).bind(name).bind(dtype).bind(shape).bind(checksum).run();
  return checksum;
}

Array readArray(Database& database, std::int64_t product, const ArrayInfo& info) {
  Array array{info.dtype, info.shape, std::vector<std::byte>(std::size_t(info.bytes))};
  Statement chunks(database,
                   "SELECT c.bytes, c.checksum, c.data FROM chunk c JOIN array a ON c.array = a.id "
                   "WHERE a.product = ? AND a.name = ? ORDER BY c.number");
  chunks.bind(product).bind(info.name);
  std::size_t at = 0, number = 0;
  for (; chunks.step(); ++number) {
    const auto bytes = std::size_t(chunks.integer(0));
    const auto packed = chunks.blob(2);
    const std::string what = "chunk " + std::to_string(number) + " of array '" + info.name + "'";
    if (checksumOf(packed) != chunks.text(1)) damaged(database, what + " does not match its checksum");
    if (bytes > array.bytes.size() - at) damaged(database, what + " is too long");
    if (ZSTD_decompress(array.bytes.data() + at, bytes, packed.data(), packed.size()) != bytes)
      damaged(database, what + " cannot be decompressed");
    at += bytes;
  }
  if (at != array.bytes.size()) damaged(database, "array '" + info.name + "' is incomplete");
  return array;
}

std::int64_t nextProductId(Database& database) {
  return 1 + database.integer(
                 "SELECT max(coalesce((SELECT max(id) FROM product), 0), "
                 "coalesce((SELECT max(product) FROM array), 0))");
}

std::int64_t nextArrayId(Database& database) {
  return 1 + database.integer(
                 "SELECT max(coalesce((SELECT max(id) FROM array), 0), "
                 "coalesce((SELECT max(array) FROM chunk), 0))");
}

void deleteProduct(Database& database, std::int64_t id) {
  Statement(database, "DELETE FROM chunk WHERE array IN (SELECT id FROM array WHERE product = ?)")
      .bind(id)
      .run();
  Statement(database, "DELETE FROM array WHERE product = ?").bind(id).run();
  Statement(database, "DELETE FROM product WHERE id = ?").bind(id).run();
}

void deleteOrphans(Database& database) {
  database.execute("DELETE FROM array WHERE product NOT IN (SELECT id FROM product)");
  database.execute("DELETE FROM chunk WHERE array NOT IN (SELECT id FROM array)");
}

}  // namespace prt
