#pragma once

#include <CLI/CLI.hpp>

#include "commands/points/mixture_command.h"
#include "commands/points/reconstruct_command.h"

namespace pdc {

/// The commands that begin with points.
class PointsCommands {
 public:
  /// Adds them to the program, which must outlive this.
  explicit PointsCommands(CLI::App& app);
  PointsCommands(const PointsCommands&) = delete;
  PointsCommands& operator=(const PointsCommands&) = delete;

  /// Runs the one that was given, if any. \throws as that does.
  void run() const;

 private:
  MixtureCommandRequest mMixture;
  ReconstructRequest mReconstruct;
  CLI::App *mMixtureCommand, *mReconstructCommand;
};

}  // namespace pdc
