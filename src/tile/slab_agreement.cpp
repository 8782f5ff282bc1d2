#include "tile/slab_agreement.h"

#include <fmt/format.h>

#include <algorithm>

#include "tile/slab_lock.h"

namespace pdc {
namespace detail {

std::optional<SlabFile> openSlab(const SlabFolder& folder, std::size_t slab) {
  const std::filesystem::path path = folder.slabFile(slab);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  return SlabFile(path, folder.hash(), slab);
}

bool agree(const SlabHeader& lower, const SlabHeader& upper) {
  return lower.high == upper.low && lower.lastLayer == upper.layerBefore;
}

namespace {

/// As openSlab(), but nothing for a file that has to be made again.
std::optional<SlabHeader> wholeHeader(const SlabFolder& folder, std::size_t slab) {
  try {
    const std::optional<SlabFile> file = openSlab(folder, slab);
    return file ? std::optional(file->header()) : std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<int> wantedHalo(const SlabFolder& folder, std::size_t slab) {
  const std::optional<SlabHeader> own = wholeHeader(folder, slab);
  if (!own) return kLeastHalo;
  std::optional<int> wanted;
  const auto compare = [&](std::size_t other) {
    if (other >= folder.plan().slabs.size()) return;  // Also for the one before the first.
    const std::optional<SlabHeader> header = wholeHeader(folder, other);
    if (!header || (other < slab ? agree(*header, *own) : agree(*own, *header))) return;
    // Both get twice what the narrower one had.
    const int both = 2 * std::min(own->halo, header->halo);
    if (own->halo < both) wanted = std::max(wanted.value_or(0), both);
  };
  compare(slab - 1);
  compare(slab + 1);
  return wanted;
}

std::string slabRangeText(std::size_t first, std::size_t last, std::size_t count) {
  return fmt::format("slabs {} to {} are asked for; there are {}, from 0", first, last, count);
}

}  // namespace detail

std::vector<SlabState> slabStates(const SlabFolder& folder) {
  std::vector<SlabState> states(folder.plan().slabs.size());
  std::optional<detail::SlabHeader> before;
  for (std::size_t i = 0; i < states.size(); ++i) {
    SlabState& state = states[i];
    std::optional<detail::SlabHeader> header;
    if (const auto file = detail::openSlab(folder, i)) {
      header = file->header();
      state.progress = SlabState::Progress::kDone;
      state.halo = header->halo;
      state.vertices = header->own.solved + header->own.added;
      state.faces = header->quads + header->triangles;
      if (before && !detail::agree(*before, *header))
        state.progress = states[i - 1].progress = SlabState::Progress::kDisputed;
    }
    before = std::move(header);
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].progress == SlabState::Progress::kDone) continue;
    states[i].runner = detail::SlabLock::holder(folder.lockFile(i));
    if (!states[i].runner.empty()) states[i].progress = SlabState::Progress::kRunning;
  }
  return states;
}

}  // namespace pdc
