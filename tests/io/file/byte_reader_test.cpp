#include "io/file/byte_reader.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "io/file/temporary_folder.h"
#include "pdc/error.h"

namespace pdc::detail {
namespace {

class ByteReaderTest : public testing::Test {
 protected:
  std::filesystem::path fileOf(const std::string& bytes) {
    const auto path = mFolder / "bytes";
    writeContents(path, bytes);
    return path;
  }

  TemporaryFolder mFolder;
};

TEST_F(ByteReaderTest, ReadsAFileThatIsLargerThanItsBuffer) {
  std::string contents(1'000'000, '\0');
  for (std::size_t i = 0; i < contents.size(); ++i) contents[i] = static_cast<char>(i * 2654435761U >> 24);
  ByteReader reader(fileOf(contents));
  EXPECT_EQ(reader.size(), contents.size());
  std::string read = reader.bytes(3);
  EXPECT_EQ(reader.position(), 3U);
  read += reader.bytes(300'000);
  while (reader.left() > 0) read += reader.get<char>();
  EXPECT_EQ(read, contents);
  reader.seek(10, contents.size());
  EXPECT_EQ(reader.bytes(5), contents.substr(10, 5));
  reader.skip(500'000);
  EXPECT_EQ(reader.bytes(5), contents.substr(500'015, 5));
}

TEST_F(ByteReaderTest, ReadsStringsWithTheirLength) {
  ByteReader reader(fileOf(std::string("\3\0\0\0abc\0\0\0\0", 11)));
  EXPECT_EQ(reader.string(), "abc");
  EXPECT_EQ(reader.string(), "");
  EXPECT_EQ(reader.left(), 0U);
}

TEST_F(ByteReaderTest, RefusesWhatLiesBehindTheEnd) {
  ByteReader reader(fileOf(std::string("\377\377\377\377rest", 8)));
  constexpr auto kHuge = std::numeric_limits<std::uint64_t>::max();
  EXPECT_THROW((void)reader.bytes(9), Error);
  EXPECT_THROW((void)reader.bytes(kHuge), Error);
  EXPECT_THROW(reader.skip(9), Error);
  EXPECT_THROW(reader.skip(kHuge), Error);
  EXPECT_THROW((void)reader.string(), Error);
  reader.seek(6, 8);
  EXPECT_THROW((void)reader.get<std::uint32_t>(), Error);
  EXPECT_EQ(reader.bytes(2), "st");
}

TEST_F(ByteReaderTest, RefusesWhatLiesBehindTheEndThatWasSet) {
  ByteReader reader(fileOf("12345678"));
  reader.seek(2, 5);
  EXPECT_EQ(reader.left(), 3U);
  EXPECT_THROW((void)reader.bytes(4), Error);
  EXPECT_EQ(reader.bytes(3), "345");
  EXPECT_THROW(reader.seek(0, 9), Error);
  EXPECT_THROW(reader.seek(5, 4), Error);
  reader.seek(0, 8);
  EXPECT_EQ(reader.bytes(8), "12345678");
}

TEST_F(ByteReaderTest, RefusesPathsThatAreNoFilesWithBytes) {
  EXPECT_THROW(ByteReader(mFolder / "missing"), Error);
  EXPECT_THROW(ByteReader(fileOf("")), Error);
  EXPECT_THROW(ByteReader(mFolder / "."), Error);
}

}  // namespace
}  // namespace pdc::detail
