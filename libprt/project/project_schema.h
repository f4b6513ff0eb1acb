#pragma once
// The tables of a project file and how their rows vouch for each other: a chunk's checksum covers its
// bytes, an array's its chunks, a product's its arrays, the project's its products and the recipe.
// Internal to project/.

#include "libprt/project/project_file.h"
#include "libprt/project/sqlite.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace prt {

inline constexpr int kApplicationId = 0x50525453;      // "PRTS"
inline constexpr std::size_t kChunkBytes = 1u << 20;   // uncompressed
inline constexpr std::size_t kCommitBytes = 8u << 20;  // compressed, between commits
inline const char* const kProduct = "product";
inline const char* const kCheckpoint = "checkpoint";

/// Settings that must be made before anything is written to a new database.
void prepareEmpty(Database& database);
/// The tables of a new database; inside a transaction.
void createSchema(Database& database);
/// Throws DamagedFile unless the tables are exactly ours.
void checkSchema(Database& database);
/// Throws DamagedFile unless the database's pages hang together; reads all of them.
void checkPages(Database& database);
/// Looks at the first bytes, before SQLite does: no file, folder, no project, truncated, newer. FileError.
void checkHeader(const std::filesystem::path& file);

/// The row of table `project`.
struct ProjectRow {
  std::string program;
  std::string recipe;
  std::string sources;  ///< JSON object: path to hash
  std::string base;     ///< checksum of the saved project that a working copy began from
  std::string checksum;
};
/// Reads it and checks it against the products. Throws DamagedFile.
ProjectRow readProjectRow(Database& database);
/// Writes it, with the checksum of what the database holds now.
void writeProjectRow(Database& database, ProjectRow row);

struct ProductRow {
  std::int64_t id = 0;
  std::string role;
  ProductInfo info;
};
/// All rows of `product`, with their arrays, each checked; ordered by stage, key, role.
std::vector<ProductRow> readProductRows(Database& database);

/// Appends an array's chunks and its row. Commits whenever enough was written; a transaction is open
/// before and after. Returns its checksum. `check` is called before every chunk and may throw.
std::string writeArray(Database& database, std::int64_t product, const std::string& name, const Array& array,
                       std::size_t& uncommitted, const std::function<void()>& check);
/// Reads and checks one array of a product.
Array readArray(Database& database, std::int64_t product, const ArrayInfo& info);

/// Ids that no row has or is meant for, what an interrupted write left included.
std::int64_t nextProductId(Database& database);
std::int64_t nextArrayId(Database& database);

/// Removes a product's row, arrays and chunks.
void deleteProduct(Database& database, std::int64_t id);
/// Removes what an interrupted write left.
void deleteOrphans(Database& database);

/// Checksum of a product's row; `arrays` are the checksums in order of name.
std::string productChecksum(const ProductInfo& info, const std::string& role);

}  // namespace prt
