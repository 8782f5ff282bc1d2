// What a person at a terminal sees: standard error is a pseudo-terminal here.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <regex>
#include <stdexcept>
#include <string>
#include <thread>

#include "apps/program.h"
#include "folders.h"

namespace pdc::test {
namespace {

class Terminal {
 public:
  Terminal() : mMaster(::posix_openpt(O_RDWR | O_NOCTTY)) {
    if (mMaster < 0 || ::grantpt(mMaster) != 0 || ::unlockpt(mMaster) != 0) throw std::runtime_error("no terminal");
    // It is held open, so that nothing is lost when the program ends.
    mHeld = ::open(name().c_str(), O_RDWR | O_NOCTTY);
    ::fcntl(mMaster, F_SETFL, O_NONBLOCK);
  }
  ~Terminal() {
    ::close(mHeld);
    ::close(mMaster);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  [[nodiscard]] std::string name() const { return ::ptsname(mMaster); }
  [[nodiscard]] std::string shown() const {
    std::string all;
    std::array<char, 4096> part;
    for (ssize_t n = 0; (n = ::read(mMaster, part.data(), part.size())) > 0;) all.append(part.data(), n);
    return all;
  }

 private:
  int mMaster, mHeld = -1;
};

std::string shownBy(const Arguments& arguments, double seconds) {
  const Terminal terminal;
  EXPECT_EQ(runPdc(arguments, {.interruptAfter = seconds, .standardError = terminal.name()}).exitCode, 130);
  return terminal.shown();
}

Arguments longWork(const TemporaryFolder& folder) {
  return {"mesh", sourceFolder() / "scenes/csg.yaml", folder / "out.ply", "--resolution", "1500"};
}

TEST(Progress, HasARateAndTheTimeLeft) {
  const TemporaryFolder folder;
  const std::string shown = shownBy(longWork(folder), 3);
  EXPECT_TRUE(std::regex_search(shown, std::regex(R"(\[=* *\] +\d+ % [a-z ]+, [0-9.e+-]+ %/s, [0-9:]+ (s|min) left)")))
      << shown;
  // The bar is wiped in the end.
  EXPECT_NE(shown.find("\r\033[Kpdc: interrupted"), std::string::npos) << shown;
}

TEST(Progress, QuietShowsNothing) {
  const TemporaryFolder folder;
  Arguments arguments = longWork(folder);
  arguments.push_back("--quiet");
  EXPECT_EQ(shownBy(arguments, 1.5), "pdc: interrupted\r\n");
}

TEST(Progress, WhatCannotSayHowFarItIsCountsSeconds) {
  const TemporaryFolder folder;
  const std::string pipe = folder / "out.ply";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(shownBy({"mesh", bulletGrid(), pipe}, 1.8).find("writing out.ply, 1 s"), std::string::npos);
}

}  // namespace
}  // namespace pdc::test
