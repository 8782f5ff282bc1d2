#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pdc::test {

/// A folder that exists as long as this object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return mPath / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return mPath; }
  /// Makes a file and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const;
  /// Names of all entries, hidden ones too, sorted.
  [[nodiscard]] std::vector<std::string> entries() const;

 private:
  std::filesystem::path mPath;
};

struct Outcome {
  int exitCode = -1;  ///< -1 if the program did not exit by itself.
  std::string out, err;
  double secondsAfterSignal = 0;
};

using Arguments = std::vector<std::string>;

struct RunOptions {
  double interruptAfter = 0;        ///< Seconds from when it catches SIGINT to when it gets it; 0 for never.
  std::string standardOutput = {};  ///< A file or device in place of the captured output.
  std::string standardError = {};   ///< A file or device in place of the captured errors.
};

/// Runs the built pdc with these arguments and waits for it.
[[nodiscard]] Outcome runPdc(const Arguments& arguments, const RunOptions& options = {});

/// Expects that the program refused with this exit code and one line of its own on standard error, which holds these
/// texts.
void expectOneLineRefusal(const Outcome& outcome, int exitCode, const std::vector<std::string>& mentions);

[[nodiscard]] std::string readFile(const std::filesystem::path& path);

/// The small grid that comes with the project: a level set, 85 x 35 x 35 voxels.
[[nodiscard]] std::filesystem::path bulletGrid();

}  // namespace pdc::test
