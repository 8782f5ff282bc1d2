#pragma once

#include <mutex>

namespace pdc::detail {

/// While it lives, OpenMesh prints nothing and no other thread of this library is in OpenMesh, whose readers and
/// streams are global objects with state.
class OpenMeshQuiet {
 public:
  OpenMeshQuiet();
  ~OpenMeshQuiet();
  OpenMeshQuiet(const OpenMeshQuiet&) = delete;
  OpenMeshQuiet& operator=(const OpenMeshQuiet&) = delete;

 private:
  std::lock_guard<std::mutex> mLock;
  bool mLog, mOut, mErr;
};

}  // namespace pdc::detail
