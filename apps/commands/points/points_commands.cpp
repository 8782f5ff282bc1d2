#include "commands/points/points_commands.h"

namespace pdc {

PointsCommands::PointsCommands(CLI::App& app)
    : mMixtureCommand(app.add_subcommand("mixture", "Write points as the Gaussians of a mixture")),
      mReconstructCommand(app.add_subcommand("reconstruct", "Make a surface of points, which need no normals")) {
  addMixtureCommandOptions(*mMixtureCommand, mMixture);
  addReconstructOptions(*mReconstructCommand, mReconstruct);
}

void PointsCommands::run() const {
  if (mMixtureCommand->parsed()) runMixture(mMixture);
  if (mReconstructCommand->parsed()) runReconstruct(mReconstruct);
}

}  // namespace pdc
