#pragma once
// What a stage makes: an immutable value, shared by everybody who looks at it, that can be written as
// named arrays and read back.

#include "libprt/core/array.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace prt {

/// A product as the project file keeps it.
struct ProductData {
  std::string meta = "{}";  ///< JSON object: everything that is not bulk
  std::map<std::string, Array> arrays;

  std::size_t bytes() const;
  /// The array of that name. Throws FileError when there is none or its type or rank differ: a project
  /// file is not to be trusted.
  const Array& array(const std::string& name, DType dtype, std::size_t rank) const;
};

class Product {
 public:
  virtual ~Product() = default;
  virtual ProductData save() const = 0;
};

using ProductPtr = std::shared_ptr<const Product>;

/// A product and how final it is.
struct ProductState {
  ProductPtr product;
  std::string key;  ///< hash of everything that the product depends on
  int level = 0;    ///< passes done
  int levels = 0;   ///< passes wanted; final when level == levels

  bool final() const { return product && level >= levels; }
};

/// Where products outlive the run that made them: the project file, or memory in tests.
class ProductStore {
 public:
  virtual ~ProductStore() = default;

  /// The product as stored, or nothing. A preview is given too: look at level and levels.
  struct Stored {
    ProductData data;
    int level = 0;
    int levels = 0;
  };
  virtual std::unique_ptr<Stored> find(const std::string& stage, const std::string& key) = 0;
  /// Called again and again during a write; what it throws ends the write, and the store holds what it held.
  using WriteCheck = std::function<void()>;
  /// Replaces what is there under the stage and key.
  virtual void put(const std::string& stage, const std::string& key, const Stored& stored,
                   const WriteCheck& check = {}) = 0;

  /// Unfinished work of a stage: accumulators and the range of samples in them.
  virtual std::unique_ptr<ProductData> findCheckpoint(const std::string& stage, const std::string& key) = 0;
  virtual void putCheckpoint(const std::string& stage, const std::string& key, const ProductData& data,
                             const WriteCheck& check = {}) = 0;
  /// Removes it, if there is one.
  virtual void dropCheckpoint(const std::string& stage, const std::string& key) = 0;

  /// Hash of a source file as it was last seen; empty when never. Lets a project open without its sources.
  virtual std::string sourceHash(const std::string& path) = 0;
  virtual void putSourceHash(const std::string& path, const std::string& hash) = 0;
};

}  // namespace prt
