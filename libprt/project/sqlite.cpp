#include "libprt/project/sqlite.h"

#include <sqlite3.h>

#include <system_error>

namespace prt {
namespace {

constexpr int kMaxValueBytes = 64 << 20;  // no row of ours is larger; damaged lengths end here

/// file: URI; what is special in one is written as %XX.
std::string uriOf(const std::filesystem::path& file, const char* query) {
  static const char* const digits = "0123456789abcdef";
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(file).string()) {
    const unsigned char byte = (unsigned char)c;
    if (std::isalnum(byte) || c == '/' || c == '.' || c == '-' || c == '_')
      uri += c;
    else
      uri += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  return uri + query;
}

}  // namespace

Database::Database(const std::filesystem::path& file, Mode mode) : file_(file) {
  const bool reading = mode == Mode::ReadOnly;
  const int flags = SQLITE_OPEN_URI | SQLITE_OPEN_FULLMUTEX | SQLITE_OPEN_EXRESCODE |
                    (reading ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE) |
                    (mode == Mode::Create ? SQLITE_OPEN_CREATE : 0);
  const std::string uri = uriOf(file, reading ? "?immutable=1" : "");
  if (const int code = sqlite3_open_v2(uri.c_str(), &handle_, flags, nullptr); code != SQLITE_OK) {
    const std::string reason = sqlite3_errstr(code);
    sqlite3_close(handle_);
    throw FileError("cannot be opened: " + reason, file.string(), "check that it exists and its permissions");
  }
  // A project file may come from anywhere: nothing in its schema is trusted, and no value is huge.
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_limit(handle_, SQLITE_LIMIT_LENGTH, kMaxValueBytes);
  sqlite3_busy_timeout(handle_, 200);
}

Database::~Database() {
  sqlite3_close_v2(handle_);
}

void Database::execute(const char* sql) {
  if (const int code = sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr); code != SQLITE_OK) fail(code);
}

std::int64_t Database::integer(const char* sql) {
  Statement query(*this, sql);
  if (!query.step()) throw DamagedFile("is damaged: a value is missing", file_.string(), "use a backup");
  return query.integer(0);
}

bool Database::inTransaction() const {
  return sqlite3_get_autocommit(handle_) == 0;
}

void Database::fail(int code) const {
  const std::string where = file_.string();
  switch (code & 0xff) {
    case SQLITE_FULL:
      throw ResourceError("the disk is full", where,
                          "free some space and run again; what was saved is unchanged");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw FileError("is in use by another program", where, "wait until it has finished");
    case SQLITE_IOERR:
      throw FileError("cannot be written or read: " +
                          std::error_code(sqlite3_system_errno(handle_), std::generic_category()).message(),
                      where, "check the disk; what was saved is unchanged");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
      throw FileError("cannot be written", where, "check its permissions and those of its folder");
    case SQLITE_NOMEM:
      throw ResourceError("not enough memory", where, "close other programs");
    default:
      throw DamagedFile(std::string("is damaged: ") + sqlite3_errmsg(handle_), where,
                        "use a backup or bake again");
  }
}

Statement::Statement(Database& database, const char* sql) : database_(database) {
  const int code = sqlite3_prepare_v2(database.handle_, sql, -1, &statement_, nullptr);
  if (code != SQLITE_OK) database.fail(code);
}

Statement::~Statement() {
  sqlite3_finalize(statement_);
}

Statement& Statement::bind(std::int64_t value) {
  sqlite3_bind_int64(statement_, ++bound_, value);
  return *this;
}

Statement& Statement::bind(const std::string& text) {
  sqlite3_bind_text(statement_, ++bound_, text.data(), int(text.size()), SQLITE_TRANSIENT);
  return *this;
}

Statement& Statement::bind(std::span<const std::byte> blob) {
  sqlite3_bind_blob64(statement_, ++bound_, blob.data(), blob.size(), SQLITE_STATIC);
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_.fail(code);
  sqlite3_reset(statement_);
  bound_ = 0;
  return false;
}

void Statement::run() {
  while (step()) {
  }
}

namespace {
void requireType(sqlite3_stmt* statement, int column, int type, const Database& database) {
  if (sqlite3_column_type(statement, column) != type)
    throw DamagedFile("is damaged: a value has the wrong type", database.file().string(),
                      "use a backup or bake again");
}
}  // namespace

std::int64_t Statement::integer(int column) const {
  requireType(statement_, column, SQLITE_INTEGER, database_);
  return sqlite3_column_int64(statement_, column);
}

std::string Statement::text(int column) const {
  requireType(statement_, column, SQLITE_TEXT, database_);
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return {bytes, std::size_t(sqlite3_column_bytes(statement_, column))};
}

std::span<const std::byte> Statement::blob(int column) const {
  requireType(statement_, column, SQLITE_BLOB, database_);
  const auto* bytes = static_cast<const std::byte*>(sqlite3_column_blob(statement_, column));
  return {bytes, std::size_t(sqlite3_column_bytes(statement_, column))};
}

Transaction::~Transaction() {
  if (!open_ || !database_.inTransaction()) return;
  try {
    database_.execute("ROLLBACK");
  } catch (...) {  // the connection rolls back when it closes
  }
}

void Transaction::commit() {
  database_.execute("COMMIT");
  open_ = false;
}

}  // namespace prt
