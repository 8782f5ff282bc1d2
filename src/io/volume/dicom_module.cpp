#include "io/volume/dicom_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

#include "pdc/error.h"

namespace pdc::detail {
namespace {

namespace fs = std::filesystem;

/// The folder of the program, or of the shared library that this function is in.
fs::path ownFolder() {
  static const char mark = 0;
  Dl_info info{};
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  if (::dladdr(&mark, &info) == 0 || info.dli_fname == nullptr) return program.parent_path();
  const fs::path own(info.dli_fname);
  // A program is named as it was called.
  const bool isLibrary = own.filename().string().find(".so") != std::string::npos;
  return isLibrary ? fs::weakly_canonical(own, ignored).parent_path() : program.parent_path();
}

std::vector<fs::path> modulePlaces() {
  const fs::path own = ownFolder(), name = "pdc_dicom.so";
  return {own / name, own.parent_path() / "lib" / "pdc" / name, own.parent_path().parent_path() / "lib" / "pdc" / name,
          fs::path(PDC_MODULE_DIR) / name};
}

const DicomModule& load() {
  std::string last;
  for (const fs::path& place : modulePlaces()) {
    void* module = ::dlopen(place.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) {
      last = ::dlerror();
      continue;
    }
    if (const void* found = ::dlsym(module, "pdcDicomModule")) return *static_cast<const DicomModule*>(found);
    last = ::dlerror();
    ::dlclose(module);
  }
  throw Error(fmt::format("DICOM is not read: this pdc was built without GDCM, or its module is not there ({})", last));
}

}  // namespace

const DicomModule& dicomModule() {
  static const DicomModule& module = load();
  return module;
}

}  // namespace pdc::detail
