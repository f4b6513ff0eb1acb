#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace prt::fuzz {
namespace {

constexpr std::size_t kLongest = 1 << 16;

const char* const kNumbers[] = {
    "0",          "-1",         "1",    "2147483647", "2147483648", "-2147483649",
    "4294967295", "4294967296", "1e39", "-1e309",     "1e-320",     "99999999999999999999",
    "nan",        "inf",        "-0",   "65536",      "255",        "0.1e"};

const std::uint64_t kIntegers[] = {0,
                                   1,
                                   0x7f,
                                   0x80,
                                   0xff,
                                   0x7fff,
                                   0xffff,
                                   0x7fffffff,
                                   0x80000000,
                                   0xfffffffe,
                                   0xffffffff,
                                   0x7fffffffffffffff,
                                   0xffffffffffffffff,
                                   0x7fc00000,
                                   0x7f800000};

bool inNumber(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+';
}

}  // namespace

Mutator::Mutator(std::vector<std::string> seeds, std::vector<std::string> words, std::uint64_t seed)
    : seeds_(std::move(seeds)), words_(std::move(words)), random_(seed) {
  if (seeds_.empty()) seeds_.push_back("");
}

std::string Mutator::next() {
  std::string input = anySeed();
  const std::size_t changes = 1 + below(8);
  for (std::size_t i = 0; i < changes; ++i) change(input);
  if (input.size() > kLongest) input.resize(kLongest);
  return input;
}

void Mutator::change(std::string& input) {
  const std::size_t at = below(input.size() + 1),
                    length = std::min(1 + below(32), input.size() - std::min(at, input.size()));
  switch (below(10)) {
    case 0:
      if (at < input.size()) input[at] = char(input[at] ^ (1 << below(8)));
      break;
    case 1:
      if (at < input.size()) input[at] = char(random_());
      break;
    case 2:
      input.erase(at, length);
      break;
    case 3:
      input.resize(at);
      break;
    case 4:
      input.insert(below(input.size() + 1), input.substr(at, length * (1 + below(8))));
      break;
    case 5: {
      const std::string& other = anySeed();
      const std::size_t from = below(other.size() + 1);
      input.insert(at, other.substr(from, 1 + below(64)));
      break;
    }
    case 6:
    case 7:
      blowUpNumber(input);
      break;
    case 8:
      setInteger(input);
      break;
    default:
      if (!words_.empty()) input.insert(at, words_[below(words_.size())]);
  }
}

/// Replaces a number that stands in text.
void Mutator::blowUpNumber(std::string& input) {
  const std::size_t start = below(input.size() + 1);
  const auto begin = std::find_if(input.begin() + std::ptrdiff_t(start), input.end(), inNumber);
  const auto end = std::find_if_not(begin, input.end(), inNumber);
  if (begin != end) input.replace(begin, end, kNumbers[below(std::size(kNumbers))]);
}

/// Overwrites one to eight bytes with an integer of either byte order.
void Mutator::setInteger(std::string& input) {
  const std::size_t size = std::size_t{1} << below(4), at = below(input.size() + 1);
  if (at + size > input.size()) return;
  char bytes[8];
  const std::uint64_t value = kIntegers[below(std::size(kIntegers))];
  std::memcpy(bytes, &value, 8);
  if (below(2) == 0) std::reverse(bytes, bytes + size);
  input.replace(at, size, bytes, size);
}

}  // namespace prt::fuzz
