#pragma once
// SQLite behind two small types: errors become ours, values are typed, everything is closed by itself.
// Internal to project/.

#include "libprt/core/error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace prt {

class Database;

/// The file is not what it must be, as opposed to: it cannot be reached.
class DamagedFile : public FileError {
 public:
  using FileError::FileError;
};

/// A prepared statement. Bind, then step through the rows.
class Statement {
 public:
  Statement(Database& database, const char* sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::int64_t value);
  Statement& bind(const std::string& text);
  /// The bytes must live until the statement has run.
  Statement& bind(std::span<const std::byte> blob);

  /// True while there is a row.
  bool step();
  /// Runs a statement without rows; the statement may then be bound and run again.
  void run();

  /// Columns of the current row. A column of another type throws FileError: the file is damaged.
  std::int64_t integer(int column) const;
  std::string text(int column) const;
  std::span<const std::byte> blob(int column) const;  ///< valid until the next step

 private:
  Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

class Database {
 public:
  enum class Mode { ReadOnly, ReadWrite, Create };

  /// ReadOnly takes the file as unchanging and leaves nothing beside it.
  Database(const std::filesystem::path& file, Mode mode);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const char* sql);
  std::int64_t integer(const char* sql);  ///< the one value of a query
  bool inTransaction() const;
  const std::filesystem::path& file() const { return file_; }

  /// Throws what an SQLite result code means: ResourceError when the disk is full, else FileError.
  [[noreturn]] void fail(int code) const;

 private:
  friend class Statement;
  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

/// All or nothing: rolls back unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) { database.execute("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace prt
