#include "core/base/recycled.h"

#include <array>
#include <cstdlib>
#include <new>

namespace irk {
namespace {

constexpr std::size_t kLine = 64;    // bytes of a cache line; sizes are rounded up to whole lines
constexpr std::size_t kSizes = 128;  // larger objects, above 8 kB, are not kept; an integrator has 5 kB
// With the address sanitizer nothing is kept, so that it sees the use of a destroyed object.
#ifdef __SANITIZE_ADDRESS__
constexpr int kMost = 0;
#else
constexpr int kMost = 8;  // members of a family that variable order uses in a run are about so many
#endif

struct Block {
  Block* next;
};

// The free blocks of a thread, by their number of lines.
struct FreeBlocks {
  struct List {
    Block* first = nullptr;
    int count = 0;
  };
  std::array<List, kSizes> lists;
  FreeBlocks() = default;
  FreeBlocks(const FreeBlocks&) = delete;
  FreeBlocks& operator=(const FreeBlocks&) = delete;
  ~FreeBlocks();
};

// Objects of static storage may be destroyed after the list of the main thread.
thread_local bool ended = false;
thread_local FreeBlocks free_blocks;

FreeBlocks::~FreeBlocks() {
  ended = true;
  for (const List& list : lists) {
    for (Block* block = list.first; block;) {
      Block* const next = block->next;
      std::free(block);
      block = next;
    }
  }
}

std::size_t linesOf(std::size_t bytes) { return (bytes + kLine - 1) / kLine; }

}  // namespace

void* Recycled::operator new(std::size_t bytes) {
  const std::size_t lines = linesOf(bytes);
  if (lines < kSizes && !ended) {
    FreeBlocks::List& list = free_blocks.lists[lines];
    if (list.first) {
      Block* const block = list.first;
      list.first = block->next;
      --list.count;
      return block;
    }
  }
  void* const block = std::aligned_alloc(kLine, lines * kLine);
  if (!block) throw std::bad_alloc();
  return block;
}

void Recycled::operator delete(void* block, std::size_t bytes) noexcept {
  if (!block) return;
  const std::size_t lines = linesOf(bytes);
  if (lines < kSizes && !ended && free_blocks.lists[lines].count < kMost) {
    FreeBlocks::List& list = free_blocks.lists[lines];
    list.first = new (block) Block{list.first};
    ++list.count;
    return;
  }
  std::free(block);
}

}  // namespace irk
