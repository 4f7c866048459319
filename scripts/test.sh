#!/usr/bin/env bash
# Installs the dependencies, builds everything in build/ and runs every test and example. Arguments go to ctest.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_dependencies.sh
. scripts/build.sh
build_quietly
echo "testing:"
ctest --preset release --parallel "$(nproc)" "$@"
