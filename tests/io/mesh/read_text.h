#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "io/file/temporary_folder.h"
#include "pdc/error.h"
#include "pdc/io/mesh/mesh_reader.h"

namespace pdc {

/// Reads `contents` from a file of that name. \param warnings gets what the reader warns of, without the file's name.
inline Mesh readText(const std::string& name, std::string_view contents, std::vector<std::string>* warnings = nullptr) {
  const TemporaryFolder folder;
  writeContents(folder / name, contents);
  const std::string prefix = (folder / name).string() + ": ";
  const auto warn = [&](const std::string& warning) {
    EXPECT_TRUE(warning.starts_with(prefix)) << warning;
    if (warnings != nullptr) warnings->push_back(warning.substr(prefix.size()));
  };
  return readMesh(folder / name, {.warn = warn});
}

/// What the error says after the file's name; empty if there is none.
inline std::string errorOf(const std::string& name, std::string_view contents) {
  const TemporaryFolder folder;
  writeContents(folder / name, contents);
  try {
    static_cast<void>(readMesh(folder / name));
    return "";
  } catch (const Error& error) {
    const std::string prefix = (folder / name).string() + ": ", message = error.what();
    EXPECT_TRUE(message.starts_with(prefix)) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message.substr(prefix.size());
  }
}

/// What the reader warns of.
inline std::vector<std::string> warningsOf(const std::string& name, std::string_view contents) {
  std::vector<std::string> warnings;
  static_cast<void>(readText(name, contents, &warnings));
  return warnings;
}

/// The bytes of numbers as they lie in memory.
template <typename... Values>
std::string bytes(Values... values) {
  std::string result;
  (result.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
  return result;
}

}  // namespace pdc
