#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>

#include "pdc/subdivide/subdivide.h"

namespace pdc {

/// Where `pdc subdivide` takes the covariances of vertices from.
enum class CovarianceChoice { kFaces, kVertices, kNormals, kFile, kNone };

/// What the command line of `pdc subdivide` says.
struct SubdivideRequest {
  std::filesystem::path input, output, json;
  SubdivideOptions options;
  CovarianceChoice covariance = CovarianceChoice::kFaces;
  std::optional<int> levels, threads;
  std::optional<double> bias, absoluteBias, sigmaNormal;
  bool ascii = false, quiet = false;
};

void addSubdivideOptions(CLI::App& command, SubdivideRequest& request);

/// Reads a mesh and writes a smooth one of more faces. \throws Error, Cancelled, CLI::ValidationError.
void runSubdivide(const SubdivideRequest& request);

}  // namespace pdc
