#pragma once
// Deterministic mutation of inputs: what hostile and broken files look like.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace prt::fuzz {

class Mutator {
 public:
  Mutator(std::vector<std::string> seeds, std::vector<std::string> words, std::uint64_t seed);

  /// A seed after one to eight changes: bits flipped, bytes set to extremes, blocks cut out, doubled, moved
  /// in from another seed, the end cut off, numbers in text or binary blown up, words put in.
  std::string next();

 private:
  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : std::size_t(random_() % bound); }
  const std::string& anySeed() { return seeds_[below(seeds_.size())]; }
  void change(std::string& input);
  void blowUpNumber(std::string& input);
  void setInteger(std::string& input);

  std::vector<std::string> seeds_, words_;
  std::mt19937_64 random_;
};

}  // namespace prt::fuzz
