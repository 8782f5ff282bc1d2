#include "commands/points/points_commands.h"

#include "files/pipes.h"

namespace pdc {

PointsCommands::PointsCommands(CLI::App& app)
    : mMixtureCommand(app.add_subcommand("mixture", "Write points as the Gaussians of a mixture")),
      mReconstructCommand(app.add_subcommand("reconstruct", "Make a surface of points, which need no normals")) {
  addMixtureCommandOptions(*mMixtureCommand, mMixture);
  addPipes(*mMixtureCommand, mMixture.input, &mMixture.output);
  addReconstructOptions(*mReconstructCommand, mReconstruct);
  addPipes(*mReconstructCommand, mReconstruct.input, &mReconstruct.output);
}

void PointsCommands::run() const {
  if (mMixtureCommand->parsed()) runMixture(mMixture);
  if (mReconstructCommand->parsed()) runReconstruct(mReconstruct);
}

}  // namespace pdc
