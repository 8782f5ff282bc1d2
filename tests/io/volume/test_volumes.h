#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "io/volume/dicom_files.h"
#include "io/volume/nifti_files.h"
#include "io/volume/npy_files.h"
#include "io/volume/tiff_files.h"

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

/// Pages of the ball, the values of each deflated or not.
inline std::string ballTiff(int side, bool packed) {
  TiffPages pages(false, 16, packed);
  const std::string values = ballBytes(side);
  const std::size_t size = values.size() / static_cast<std::size_t>(side);
  for (std::size_t z = 0; z < values.size(); z += size)
    pages.add(side, side, packed ? deflated(values.substr(z, size), 15) : values.substr(z, size));
  return pages.bytes();
}

/// All slices of the ball as frames of one file.
inline std::string ballDicom(int side) {
  DicomFile file;
  file.text(0x0020, 0x000e, "UI", "1.2.3");
  file.text(0x0020, 0x0032, "DS", "1\\2\\3");
  file.text(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0");
  file.number(0x0028, 0x0002, 1);
  file.text(0x0028, 0x0004, "CS", "MONOCHROME2");
  file.text(0x0028, 0x0008, "IS", std::to_string(side));
  file.number(0x0028, 0x0010, side);
  file.number(0x0028, 0x0011, side);
  file.text(0x0028, 0x0030, "DS", "1\\1");
  file.number(0x0028, 0x0100, 16);
  file.number(0x0028, 0x0101, 16);
  file.number(0x0028, 0x0102, 15);
  file.number(0x0028, 0x0103, 1);
  file.pixels(ballBytes(side));
  return file.bytes();
}

/// Values as text, for NRRD.
inline std::string ballText(int side) {
  const std::string values = ballBytes(side);
  std::string text;
  for (std::size_t at = 0; at < values.size(); at += sizeof(std::int16_t)) {
    std::int16_t value = 0;
    std::memcpy(&value, values.data() + at, sizeof(value));
    text += std::to_string(value) + (at % 32 == 30 ? '\n' : ' ');
  }
  return text;
}

/// A file of each format with the same ball in it, by the names that their suffixes are of. The values of headers
/// without any are those of a.nii.
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
  const std::string skip = std::to_string(nifti.header().size());
  const std::string array =
      npy("{'descr': '<i2', 'fortran_order': True, 'shape': (" + n + ", " + n + ", " + n + ")}", values);
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
          {"h.npy", array},
          {"i.inr", inr + "##}\n" + values},
          {"j.npz", zip({{"volume.npy", array}}, false)},
          {"k.npz", zip({{"volume.npy", array}}, true)},
          {"l.nrrd", nrrd + "encoding: ascii\n\n" + ballText(side)},
          {"m.nhdr", nrrd + "encoding: raw\nendian: little\nbyte skip: " + skip + "\ndata file: a.nii\n"},
          {"n.mhd", meta + "HeaderSize = " + skip + "\nElementDataFile = a.nii\n"},
          {"o.tif", ballTiff(side, false)},
          {"p.tif", ballTiff(side, true)},
          {"q.dcm", ballDicom(side)}};
}

}  // namespace pdc
