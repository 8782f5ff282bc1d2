#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/volume/nifti_files.h"

namespace pdc {

/// Values above 100 in a ball and none below 0, x running fastest.
inline std::string ballBytes(int side, bool bigEndian = false) {
  std::string bytes;
  const double middle = (side - 1) / 2.0;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const double r = std::hypot(x - middle, y - middle, z - middle);
        bytes +=
            bytesOf(static_cast<std::int16_t>(std::lround(std::max(0.0, 100 + 20 * (middle - 1.5 - r)))), bigEndian);
      }
  return bytes;
}

/// A file of each format with the same ball in it, by the names that their suffixes are of.
inline std::vector<std::pair<std::string, std::string>> ballFiles(int side) {
  const std::string n = std::to_string(side), values = ballBytes(side);
  NiftiFile nifti;
  nifti.dim = {side, side, side};
  nifti.sformCode = nifti.qformCode = 1;
  nifti.sform = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0};
  NiftiFile second = nifti;
  second.second = second.bigEndian = true;
  const std::string sizes = n + " " + n + " " + n;
  const std::string nrrd = "NRRD0004\ntype: short\ndimension: 3\nsizes: " + sizes +
                           "\nspace: RAS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n";
  const std::string meta = "ObjectType = Image\nNDims = 3\nDimSize = " + sizes +
                           "\nElementType = MET_SHORT\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nElementSpacing = 1 1 1\n";
  const std::string shape = "{'descr': '<i2', 'fortran_order': True, 'shape': (" + n + ", " + n + ", " + n + ")}\n";
  std::string inr = "#INRIMAGE-4#{\nXDIM=" + n + "\nYDIM=" + n + "\nZDIM=" + n +
                    "\nVDIM=1\nTYPE=signed fixed\nPIXSIZE=16 bits\nCPU=decm\nVX=1\nVY=1\nVZ=1\n";
  inr.resize(252, '\n');
  return {{"a.nii", nifti.header() + values},
          {"b.nii", second.header() + ballBytes(side, true)},
          {"c.nii.gz", deflated(nifti.header() + values)},
          {"d.nrrd", nrrd + "encoding: raw\nendian: little\n\n" + values},
          {"e.nrrd", nrrd + "encoding: gzip\nendian: little\n\n" + deflated(values)},
          {"f.mha", meta + "ElementDataFile = LOCAL\n" + values},
          {"g.mha", meta + "CompressedData = True\nElementDataFile = LOCAL\n" + deflated(values, 15)},
          {"h.npy",
           "\x93NUMPY\x01" + std::string(1, '\0') + bytesOf(static_cast<std::uint16_t>(shape.size())) + shape + values},
          {"i.inr", inr + "##}\n" + values}};
}

}  // namespace pdc
