#include "libprt/project/project_schema.h"

#include "libprt/core/hash.h"

#include <array>
#include <cstring>
#include <fstream>
#include <system_error>

namespace prt {
namespace {

namespace fs = std::filesystem;

constexpr int kPageBytes = 65536;

struct Table {
  const char* name;
  const char* sql;
};

constexpr std::array<Table, 4> kTables{{
    {"project",
     "CREATE TABLE project(id INTEGER PRIMARY KEY CHECK(id = 1), program TEXT NOT NULL, recipe TEXT NOT "
     "NULL, "
     "sources TEXT NOT NULL, base TEXT NOT NULL, checksum TEXT NOT NULL)"},
    {"product",
     "CREATE TABLE product(id INTEGER PRIMARY KEY, stage TEXT NOT NULL, key TEXT NOT NULL, role TEXT NOT "
     "NULL, "
     "level INTEGER NOT NULL, levels INTEGER NOT NULL, meta TEXT NOT NULL, checksum TEXT NOT NULL)"},
    {"array",
     "CREATE TABLE array(id INTEGER PRIMARY KEY, product INTEGER NOT NULL, name TEXT NOT NULL, dtype TEXT "
     "NOT NULL, "
     "shape TEXT NOT NULL, checksum TEXT NOT NULL)"},
    {"chunk",
     "CREATE TABLE chunk(id INTEGER PRIMARY KEY, array INTEGER NOT NULL, number INTEGER NOT NULL, "
     "bytes INTEGER NOT NULL, checksum TEXT NOT NULL, data BLOB NOT NULL)"},
}};

constexpr std::array<Table, 2> kIndexes{{
    {"array_of_product", "CREATE INDEX array_of_product ON array(product, name)"},
    {"chunk_of_array", "CREATE INDEX chunk_of_array ON chunk(array, number)"},
}};

std::uint32_t bigEndian(const unsigned char* p) {
  return std::uint32_t(p[0]) << 24 | std::uint32_t(p[1]) << 16 | std::uint32_t(p[2]) << 8 | p[3];
}

std::string projectChecksum(Database& database, const ProjectRow& row) {
  std::string text = row.program + "\n" + row.recipe + "\n" + row.sources + "\n" + row.base + "\n";
  Statement products(database, "SELECT checksum FROM product ORDER BY checksum");
  while (products.step()) text += products.text(0) + "\n";
  return hashBytes(std::as_bytes(std::span(text))).hex();
}

}  // namespace

void prepareEmpty(Database& database) {
  database.execute(("PRAGMA page_size = " + std::to_string(kPageBytes)).c_str());
  database.execute("PRAGMA auto_vacuum = INCREMENTAL");
}

void createSchema(Database& database) {
  database.execute(("PRAGMA application_id = " + std::to_string(kApplicationId)).c_str());
  database.execute(("PRAGMA user_version = " + std::to_string(kProjectFormat)).c_str());
  for (const Table& table : kTables) database.execute(table.sql);
  for (const Table& index : kIndexes) database.execute(index.sql);
}

void checkSchema(Database& database) {
  Statement rows(database, "SELECT name, sql FROM sqlite_schema ORDER BY rowid");
  std::vector<Table> wanted(kTables.begin(), kTables.end());
  wanted.insert(wanted.end(), kIndexes.begin(), kIndexes.end());
  std::size_t i = 0;
  bool same = true;
  for (; rows.step(); ++i)
    same = same && i < wanted.size() && rows.text(0) == wanted[i].name && rows.text(1) == wanted[i].sql;
  if (!same || i != wanted.size())
    throw DamagedFile("is damaged: its tables are not those of a project", database.file().string(),
                      "use a backup or bake again");
}

void checkPages(Database& database) {
  Statement check(database, "PRAGMA integrity_check(1)");
  if (!check.step() || check.text(0) != "ok")
    throw DamagedFile("is damaged: " + check.text(0), database.file().string(), "use a backup or bake again");
}

void checkHeader(const fs::path& file) {
  const std::string where = file.string();
  std::error_code error;
  if (fs::is_directory(file, error)) throw FileError("is a folder, not a project", where, "give a .prt file");
  const auto size = fs::file_size(file, error);
  if (error) throw FileError("cannot be read: " + error.message(), where, "check the path");
  std::array<unsigned char, 100> header{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(header.data()), header.size());
  if (!stream || std::memcmp(header.data(), "SQLite format 3\0", 16) != 0)
    throw DamagedFile("is not a PRT project", where,
                      size == 0 ? "it is empty" : "give a .prt file that prt bake wrote");
  if (bigEndian(&header[68]) != std::uint32_t(kApplicationId))
    throw DamagedFile("is an SQLite database, but not a PRT project", where,
                      "give a .prt file that prt bake wrote");
  const std::uint32_t version = bigEndian(&header[60]);
  if (version > std::uint32_t(kProjectFormat))
    throw FileError("was written by a newer version (format " + std::to_string(version) +
                        ", this program knows " + std::to_string(kProjectFormat) + ")",
                    where, "open it with a newer prt");
  const std::uintmax_t wanted = std::uintmax_t(bigEndian(&header[28])) * kPageBytes;
  if (size < wanted)
    throw DamagedFile(
        "is truncated: " + std::to_string(size) + " of " + std::to_string(wanted) + " bytes are there", where,
        "copy it again or use a backup");
}

ProjectRow readProjectRow(Database& database) {
  Statement query(database, "SELECT program, recipe, sources, base, checksum FROM project");
  if (!query.step())
    throw DamagedFile("is damaged: it holds no recipe", database.file().string(),
                      "use a backup or bake again");
  const ProjectRow row{query.text(0), query.text(1), query.text(2), query.text(3), query.text(4)};
  if (projectChecksum(database, row) != row.checksum)
    throw DamagedFile("is damaged: the recipe or the list of products has changed since it was written",
                      database.file().string(), "use a backup or bake again");
  return row;
}

void writeProjectRow(Database& database, ProjectRow row) {
  row.program = "prt " PRT_VERSION;
  row.checksum = projectChecksum(database, row);
  Statement insert(database,
                   "INSERT OR REPLACE INTO project(id, program, recipe, sources, base, checksum) VALUES(1, "
                   "?, ?, ?, ?, ?)");
  insert.bind(row.program).bind(row.recipe).bind(row.sources).bind(row.base).bind(row.checksum).run();
}

std::string productChecksum(const ProductInfo& info, const std::string& role) {
  std::string text = info.stage + "\n" + info.key + "\n" + role + "\n" + std::to_string(info.level) + "\n" +
                     std::to_string(info.levels) + "\n" + info.meta + "\n";
  for (const ArrayInfo& array : info.arrays) text += array.checksum + "\n";
  return hashBytes(std::as_bytes(std::span(text))).hex();
}

}  // namespace prt
