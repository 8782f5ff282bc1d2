#include "extract/contour_memory.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>

#include "parallel/machine_memory.h"

namespace pdc::detail {

double contourMemory(double vertices, const ContourOptions& options) {
  constexpr double kMesh = 50, kNormals = 12, kEstimates = 48, kTriangles = 24, kQuadrics = 40, kAdaptive = 600;
  const double perVertex =
      kMesh + (options.normals ? kNormals : 0) + (options.confidence || options.ranks ? kEstimates : 0) +
      (options.triangles ? kTriangles : 0) + (options.quadrics ? kQuadrics : 0) + (options.adaptive ? kAdaptive : 0);
  return perVertex * vertices;
}

void giveBackMemory() {
  releaseMemory();
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

void checkMemory(double bytes, double vertices, const ContourOptions& options) {
  constexpr double kAlwaysThere = 32e6;  // Small meshes need not ask the system.
  if (options.maxMemory == 0 && bytes <= kAlwaysThere) return;
  double inUse = 0, machine = 0, limit = 0;
  const auto fits = [&] {
    inUse = static_cast<double>(memoryInUse());
    const auto available = static_cast<double>(availableMemory());
    machine = available > 0 ? inUse + available : bytes + inUse;
    limit = options.maxMemory > 0 ? std::min(static_cast<double>(options.maxMemory), machine) : machine;
    return bytes + inUse <= limit;
  };
  if (fits()) return;
  giveBackMemory();
  if (fits()) return;
  throw TooLarge(
      fmt::format("about {} vertices take about {} of memory, more than the {} that {}; a coarser lattice takes less",
                  countText(vertices), bytesText(bytes + inUse), bytesText(limit),
                  limit < machine ? "are allowed" : "the machine has"));
}

std::string countText(double count) {
  constexpr double kMega = 1e6, kGiga = 1e9;
  if (count < kMega) return fmt::format("{:.0f}", count);
  return count < kGiga ? fmt::format("{:.3g} million", count / kMega) : fmt::format("{:.1f} billion", count / kGiga);
}

std::string bytesText(double bytes) {
  constexpr double kKilo = 1e3, kMega = 1e6, kGiga = 1e9, kTera = 1e12;
  if (bytes < kMega) return fmt::format("{:.0f} kB", bytes / kKilo);
  if (bytes < 10 * kGiga) return fmt::format("{:.0f} MB", bytes / kMega);
  return bytes < 10 * kTera ? fmt::format("{:.0f} GB", bytes / kGiga) : fmt::format("{:.0f} TB", bytes / kTera);
}

}  // namespace pdc::detail
