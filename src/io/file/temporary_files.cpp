#include "io/file/temporary_files.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <cstring>
#include <string>

namespace pdc::detail {
namespace {

// The places are fixed, because a signal handler can neither lock nor touch memory that another thread may be freeing.
enum class SlotState { kFree, kChanging, kTaken };
struct Slot {
  std::atomic<SlotState> state = SlotState::kFree;
  std::array<char, PATH_MAX> path{};
};
constexpr int kNoSlot = -1;
constexpr int kSlots = 8;
std::array<Slot, kSlots> gSlots;
static_assert(std::atomic<SlotState>::is_always_lock_free);

}  // namespace

TemporaryFileEntry::TemporaryFileEntry(const std::filesystem::path& path) noexcept : mSlot(kNoSlot) {
  if (path.native().size() >= PATH_MAX) return;
  for (int i = 0; i < kSlots && mSlot == kNoSlot; ++i) {
    Slot& slot = gSlots[static_cast<std::size_t>(i)];
    auto expected = SlotState::kFree;
    if (!slot.state.compare_exchange_strong(expected, SlotState::kChanging)) continue;
    std::memcpy(slot.path.data(), path.c_str(), path.native().size() + 1);
    slot.state = SlotState::kTaken;
    mSlot = i;
  }
}

TemporaryFileEntry::~TemporaryFileEntry() {
  if (mSlot != kNoSlot) gSlots[static_cast<std::size_t>(mSlot)].state = SlotState::kFree;
}

void removeTemporaryFiles() noexcept {
  for (const Slot& slot : gSlots) {
    if (slot.state == SlotState::kTaken) ::unlink(slot.path.data());
  }
}

}  // namespace pdc::detail
