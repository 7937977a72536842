// Mutated texts for testing the readers of files.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <exception>
#include <random>
#include <span>
#include <string>

#include "tests/refusal.h"

namespace irk::test {

/// Valid texts with one to three random changes: a piece inserted, some characters erased, any byte inserted, a part
/// doubled. The texts are the same on every machine.
class Mutations {
 public:
  Mutations(std::span<const std::string> seeds, std::span<const std::string> pieces, unsigned seed)
      : seeds_(seeds), pieces_(pieces), random_(seed) {}

  std::string next() {
    std::string text = seeds_[below(seeds_.size())];
    for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
      const std::size_t at = below(text.size() + 1);
      switch (below(4)) {
        case 0:
          text.insert(at, pieces_[below(pieces_.size())]);
          break;
        case 1:
          text.erase(at, 1 + below(6));
          break;
        case 2:
          text.insert(at, 1, static_cast<char>(below(256)));
          break;
        default:
          text.insert(at, text.substr(below(text.size() + 1), below(30)));
      }
    }
    return text;
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_()) % n; }

  std::span<const std::string> seeds_, pieces_;
  std::mt19937 random_;
};

struct ReadTexts {
  int read = 0, refused = 0;
};

/// Reads mutated texts: each is read, or refused by a Misuse that contains `name`. The first that is neither fails the
/// test.
template <class Read>
ReadTexts readMutated(Mutations mutations, int texts, const std::string& name, const Read& read) {
  ReadTexts counts;
  for (int i = 0; i < texts && !testing::Test::HasFailure(); ++i) {
    const std::string text = mutations.next();
    try {
      read(text);
      ++counts.read;
    } catch (const Misuse& refused) {
      ++counts.refused;
      EXPECT_TRUE(contains(refused.what(), name)) << text;
    } catch (const std::exception& other) {
      ADD_FAILURE() << other.what() << "\n" << text;
    }
  }
  return counts;
}

}  // namespace irk::test
