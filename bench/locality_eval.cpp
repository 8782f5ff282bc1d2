// Contours boxes of whole blocks, with two blocks around them, and compares what lies in the boxes with the mesh of the
// whole. Prints how many boxes and faces differ.
// usage: locality_eval BOXES FILE... (.vdb and .yaml)

#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <random>

#include "eval/locality.h"
#include "pdc/extract/contour.h"
#include "pdc/io/open_input.h"

namespace {

void evaluate(const char* file, int boxes) {
  const pdc::Input input = pdc::openInput(file);
  const pdc::SurfaceBlocks blocks = input.source->surfaceBlocks({});
  const pdc::Mesh whole = pdc::contour(*input.source);
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> any(0, blocks.coords.size() - 1);
  std::uniform_int_distribution<int> size(0, 3);
  int boxesThatDiffer = 0;
  pdc::eval::FaceDifference total;
  for (int i = 0; i < boxes; ++i) {
    pdc::eval::BlockBox box{blocks.coords[any(random)], {}};
    for (int axis = 0; axis < 3; ++axis) box.hi[axis] = box.lo[axis] + size(random);
    const pdc::eval::FaceDifference d = pdc::eval::compareWithPart(*input.source, blocks, whole, box);
    boxesThatDiffer += d.different != 0;
    total.faces += d.faces;
    total.different += d.different;
  }
  fmt::print("{}: {} boxes, {} faces; {} boxes differ, in {} faces\n", file, boxes, total.faces, boxesThatDiffer,
             total.different);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: locality_eval BOXES FILE...\n");
    return 2;
  }
  try {
    for (int i = 2; i < argc; ++i) evaluate(argv[i], std::atoi(argv[1]));
  } catch (const std::exception& e) {
    fmt::print(stderr, "locality_eval: {}\n", e.what());
    return 1;
  }
}
