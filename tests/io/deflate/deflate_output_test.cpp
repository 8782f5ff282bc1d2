#include "io/deflate/deflate_output.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstring>
#include <random>
#include <string>
#include <utility>

#include "io/deflate/inflate.h"
#include "io/deflate/zip_output.h"

namespace pdc::detail {
namespace {

class Collected final : public ByteOutput {
 public:
  void write(const void* data, std::size_t size) override { mBytes.append(static_cast<const char*>(data), size); }
  [[nodiscard]] const std::string& bytes() const { return mBytes; }

 private:
  std::string mBytes;
};

/// More than what waits to be deflated at a time, and not a whole number of blocks.
std::string manyBytes() {
  std::mt19937 random(1);
  std::string bytes;
  while (bytes.size() < 17'000'001) bytes += std::to_string(random()) + std::string(random() % 200, ' ');
  return bytes;
}

std::string gzipped(const std::string& bytes, std::size_t atOnce) {
  Collected out;
  GzipOutput gzip(out);
  for (std::size_t i = 0; i < bytes.size(); i += atOnce)
    gzip.write(bytes.data() + i, std::min(atOnce, bytes.size() - i));
  gzip.finish();
  return out.bytes();
}

std::string inflated(const std::string& bytes) {
  const Buffer<char> all = inflateAll(bytes);
  return {all.begin(), all.end()};
}

TEST(GzipOutput, InflatesToWhatWasWritten) {
  const std::string bytes = manyBytes();
  const std::string packed = gzipped(bytes, 1 << 20);
  EXPECT_LT(packed.size(), bytes.size() / 2);
  EXPECT_EQ(inflated(packed), bytes);
  EXPECT_EQ(inflated(gzipped("", 1)), "");
  EXPECT_EQ(inflated(gzipped("a", 1)), "a");
}

TEST(GzipOutput, NeitherThreadsNorPiecesMatter) {
  const std::string bytes = manyBytes();
  const std::string expected = gzipped(bytes, bytes.size());
  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    arena.execute([&] { EXPECT_EQ(gzipped(bytes, 12345), expected); });
  }
}

TEST(ZipOutput, EntriesComeBack) {
  Collected out;
  ZipOutput zip(out);
  const auto fill = [](const char* text) {
    return [text](ByteOutput& entry) { entry.write(text, std::strlen(text)); };
  };
  zip.add("first", fill("once upon a time"));
  zip.add("second", fill("there was"));
  zip.finish();
  const std::string& bytes = out.bytes();
  EXPECT_EQ(bytes.substr(0, 4), "PK\x03\x04");
  // An entry's bytes follow its name; the directory, at the end, has the names again.
  for (const auto& [name, text] : {std::pair{"first", "once upon a time"}, {"second", "there was"}}) {
    const std::string rest = bytes.substr(bytes.find(name) + std::strlen(name));
    InflateStream entry(rest, DeflateWrapping::kNone);
    std::string read(std::strlen(text) + 1, '\0');
    EXPECT_EQ(entry.readSome(read.data(), read.size()), std::strlen(text));
    EXPECT_STREQ(read.c_str(), text);
    EXPECT_NE(bytes.rfind(name), bytes.find(name));
  }
}

}  // namespace
}  // namespace pdc::detail
