#include "math/hash128.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace pdc::detail {
namespace {

std::span<const char> bytes(const std::string& text) { return {text.data(), text.size()}; }

TEST(Hash128, IsThatOfTheLibrary) {
  // xxhsum -H2 of the empty file and of "abc".
  EXPECT_EQ(hashText(hashOf(bytes(""))), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hashText(hashOf(bytes("abc"))), "06b05ab6733a618578af5f94892f3950");
}

TEST(Hash128, BytesInPiecesAreThoseInOne) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += std::to_string(i * i);
  for (const std::size_t piece : {1U, 7U, 1000U, 100000U}) {
    StreamHash stream;
    for (std::size_t at = 0; at < text.size(); at += piece) {
      const std::string part = text.substr(at, piece);
      stream.add(part.data(), part.size());
    }
    EXPECT_EQ(stream.hash(), hashOf(bytes(text)));
  }
}

TEST(Hash128, WordsAreTheirBytes) {
  const std::array<std::uint64_t, 2> words{0x3837363534333231, 0x3635343332313039};
  EXPECT_EQ(hashOf(words), hashOf(bytes("1234567890123456")));
}

}  // namespace
}  // namespace pdc::detail
