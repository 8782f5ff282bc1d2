#include <gtest/gtest.h>

#include "fuzz/flips.h"
#include "fuzz/targets.h"
#include "io/volume/test_volumes.h"

namespace pdc {
namespace {

TEST(VolumeFlips, DamagedFilesGiveASoundMeshOrAnError) {
  constexpr int kSide = 10;
  WholeFiles files = ballFiles(kSide);
  files.emplace_back("r.raw", ballBytes(kSide));
  files.emplace_back("s.raw.gz", deflated(ballBytes(kSide)));
  expectReadOrRefused(files, 150, fuzzVolumeFile);
}

}  // namespace
}  // namespace pdc
