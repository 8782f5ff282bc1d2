#include "files/pipes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/file/file_error.h"
#include "io/file/mapped_file.h"
#include "io/file/temporary_files.h"
#include "io/piped_suffix.h"
#include "pdc/error.h"
#include "terminal/interrupt.h"
#include "terminal/shown_path.h"

namespace pdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInputName = "standard input";
constexpr const char* kOutputName = "standard output";

void writeAll(int to, std::span<const char> bytes, const char* name) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(to, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw Error(fmt::format("{}: cannot be written: {}", name, std::strerror(errno)));
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

/// A file of ours that goes with the program.
class TemporaryFile {
 public:
  /// Makes an empty file. \throws Error.
  explicit TemporaryFile(const std::string& name)
      : mPath(fs::temp_directory_path() / fmt::format("pdc-{}-{}", ::getpid(), name)) {
    const int file = ::open(mPath.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) throw detail::fileError(mPath, "cannot be written", errno);
    ::close(file);
    mEntry.emplace(mPath);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(mPath, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const fs::path& path() const { return mPath; }
  void addSuffix(const std::string& suffix) {
    const fs::path named(mPath.string() + suffix);
    fs::rename(mPath, named);
    mPath = named;
    mEntry.emplace(mPath);
  }

 private:
  fs::path mPath;
  std::optional<detail::TemporaryFileEntry> mEntry;
};

/// What stands for the standard streams in this run.
struct Pipes {
  std::unique_ptr<TemporaryFile> input, output;
  int standardOutput = -1;
};

Pipes& pipes() {
  static Pipes own;
  return own;
}

void keepInput(const fs::path& to) {
  const ExitOnInterrupt scope;
  const int file = ::open(to.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) throw detail::fileError(to, "cannot be written", errno);
  std::array<char, std::size_t{1} << 18> buffer;
  for (;;) {
    const ssize_t n = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw Error(fmt::format("{}: cannot be read: {}", kInputName, std::strerror(errno)));
    if (n == 0) break;
    writeAll(file, {buffer.data(), static_cast<std::size_t>(n)}, to.c_str());
  }
  ::close(file);
}

std::string suffixOf(const fs::path& path) {
  if (fs::file_size(path) == 0) return "";
  const detail::MappedFile file(path);
  const auto bytes = file.bytes();
  return detail::suffixOfBytes({bytes.data(), bytes.size()});
}

std::string withDot(const std::string& format) { return format.starts_with('.') ? format : "." + format; }

void takeInput(fs::path& input, const std::string& format) {
  pipes().input = std::make_unique<TemporaryFile>("input");
  TemporaryFile& file = *pipes().input;
  keepInput(file.path());
  const std::string suffix = format.empty() ? suffixOf(file.path()) : withDot(format);
  if (suffix.empty())
    throw Error(fmt::format("{}: {}; --input-format names its format, such as vdb", kInputName,
                            fs::file_size(file.path()) == 0 ? "is empty" : "nothing tells what its bytes are"));
  file.addSuffix(suffix);
  input = file.path();
  showPathAs(input, kInputName);
}

void takeOutput(fs::path& output, const std::string& format) {
  if (format.empty()) throw CLI::ValidationError("OUTPUT", "- needs --format, such as ply");
  pipes().output = std::make_unique<TemporaryFile>("output" + withDot(format));
  output = pipes().output->path();
  showPathAs(output, kOutputName);
  // From now on summaries and reports go to standard error, whoever writes them.
  std::fflush(stdout);
  pipes().standardOutput = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  if (pipes().standardOutput < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0)
    throw Error(fmt::format("{}: cannot be written: {}", kOutputName, std::strerror(errno)));
}

}  // namespace

void addPipes(CLI::App& command, fs::path& input, fs::path* output) {
  struct Formats {
    std::string input, output;
  };
  const auto formats = std::make_shared<Formats>();
  const auto group = "Pipes: - is standard input or output";
  command.add_option("--input-format", formats->input, "What comes from standard input, where its bytes do not tell")
      ->type_name("SUFFIX")
      ->group(group);
  if (output != nullptr)
    command.add_option("--format", formats->output, "What goes to standard output, such as ply")
        ->type_name("SUFFIX")
        ->group(group);
  command.final_callback([formats, &input, output] {
    if (input == "-") takeInput(input, formats->input);
    if (output != nullptr && *output == "-") takeOutput(*output, formats->output);
  });
}

void finishPipes() {
  if (!pipes().output) return;
  std::fflush(stdout);
  const detail::MappedFile file(pipes().output->path());
  const auto bytes = file.bytes();
  // Whoever reads may stop, which ends this process: the files have to be gone by then.
  pipes().output.reset();
  pipes().input.reset();
  writeAll(pipes().standardOutput, {bytes.data(), bytes.size()}, kOutputName);
  if (::close(pipes().standardOutput) != 0)
    throw Error(fmt::format("{}: cannot be written: {}", kOutputName, std::strerror(errno)));
}

}  // namespace pdc
