#include "io/openmesh/openmesh_quiet.h"

#include <OpenMesh/Core/System/omstream.hh>

namespace pdc::detail {
namespace {

std::mutex& openMeshMutex() {
  static std::mutex mutex;
  return mutex;
}

bool disable(OpenMesh::mostream& stream) {
  const bool enabled = stream.is_enabled();
  stream.disable();
  return enabled;
}

}  // namespace

OpenMeshQuiet::OpenMeshQuiet()
    : mLock(openMeshMutex()), mLog(disable(omlog())), mOut(disable(omout())), mErr(disable(omerr())) {}

OpenMeshQuiet::~OpenMeshQuiet() {
  if (mLog) omlog().enable();
  if (mOut) omout().enable();
  if (mErr) omerr().enable();
}

}  // namespace pdc::detail
