#pragma once
// Errors of libprt. Every message says what happened, where, and what to do about it, on one line.

#include <exception>
#include <stdexcept>
#include <string>

namespace prt {

/// Base of every error that stops a task. what() is "WHERE: WHAT (FIX)"; empty parts are left out.
class Error : public std::runtime_error {
 public:
  Error(std::string what, std::string where, std::string fix);

  const std::string& problem() const noexcept { return what_; }
  const std::string& where() const noexcept { return where_; }
  const std::string& fix() const noexcept { return fix_; }

 private:
  std::string what_, where_, fix_;
};

/// A file cannot be opened, read or written, or its contents are not what its format promises.
class FileError : public Error {
 public:
  using Error::Error;
};

/// A value given by the user (recipe, option, argument) is unknown or out of range.
class ValueError : public Error {
 public:
  using Error::Error;
};

/// Geometry that cannot be used or repaired.
class GeometryError : public Error {
 public:
  using Error::Error;
};

/// The task would need more memory or disk than there is, or a device failed.
class ResourceError : public Error {
 public:
  using Error::Error;
};

/// The user cancelled the task. Not an Error: nothing went wrong.
class Cancelled : public std::exception {
 public:
  const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace prt
