#include "math/hash128.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pdc::detail {
namespace {

Hash128 asArray(const XXH128_hash_t& hash) { return {hash.low64, hash.high64}; }

}  // namespace

struct StreamHash::State {
  XXH3_state_t state;
};

Hash128 hashOf(std::span<const char> bytes) { return asArray(XXH3_128bits(bytes.data(), bytes.size())); }

Hash128 hashOf(std::span<const std::uint64_t> words) { return asArray(XXH3_128bits(words.data(), words.size_bytes())); }

std::string hashText(const Hash128& hash) { return fmt::format("{:016x}{:016x}", hash[1], hash[0]); }

StreamHash::StreamHash() : mState(std::make_unique<State>()) { XXH3_128bits_reset(&mState->state); }

StreamHash::~StreamHash() = default;

void StreamHash::add(const void* data, std::size_t size) { XXH3_128bits_update(&mState->state, data, size); }

Hash128 StreamHash::hash() const { return asArray(XXH3_128bits_digest(&mState->state)); }

}  // namespace pdc::detail
