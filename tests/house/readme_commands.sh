#!/usr/bin/env bash
# Runs every command of README.md's ```sh blocks, in order, in a temporary folder, with the built program on the PATH.
# Left out: ./dev, which builds (and runs this), and cmake, which the consumer test stands for.
# Usage: readme_commands.sh ROOT FOLDER_OF_PDC
set -euo pipefail
readonly root=$1 programs=$2

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
ln -s "$root/scenes" "$root/tests" .

awk '/^```/ { inside = ($0 == "```sh"); next } inside' "$root/README.md" |
  grep -vE '^(\./dev|cmake) ' >commands.sh
commands=$(grep -cE '^pdc ' commands.sh)
PATH="$programs:$PATH" bash -euxo pipefail commands.sh
echo "ran $commands pdc commands of the README"
((commands >= 5))
