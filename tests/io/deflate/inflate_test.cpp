#include "io/deflate/inflate.h"

#include "io/volume/volume_files.h"

namespace pdc::detail {
namespace {

std::string inflated(const std::string& bytes) {
  const Buffer<char> all = inflateAll(bytes);
  return {all.begin(), all.end()};
}

TEST(Inflate, GzipZlibAndSeveralStreamsOneAfterTheOther) {
  EXPECT_EQ(inflated(deflated("once upon")), "once upon");
  EXPECT_EQ(inflated(deflated("once upon", 15)), "once upon");
  EXPECT_EQ(inflated(deflated("once upon") + deflated(" a time")), "once upon a time");
  EXPECT_EQ(inflated(deflated("once upon") + "padding"), "once upon");
  EXPECT_EQ(inflated(deflated("")), "");
}

TEST(Inflate, BareStreamsAndSkips) {
  const std::string bytes = deflated("once upon a time", -15);
  InflateStream stream(bytes, DeflateWrapping::kNone);
  stream.skip(5);
  std::string word(4, '\0');
  stream.read(word);
  EXPECT_EQ(word, "upon");
  std::string more(40, '\0');
  EXPECT_EQ(stream.readSome(more.data(), more.size()), 7u);
  EXPECT_THROW(stream.read(word), Error);
}

TEST(Inflate, DamageIsAnError) {
  std::string bytes = deflated(std::string(1000, 'a') + "b");
  EXPECT_THROW(inflated(bytes.substr(0, bytes.size() - 9)), Error);
  EXPECT_THROW(inflated("not deflated at all"), Error);
  bytes[12] = static_cast<char>(~bytes[12]);
  EXPECT_THROW(inflated(bytes), Error);
}

}  // namespace
}  // namespace pdc::detail
