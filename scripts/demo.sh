#!/usr/bin/env bash
# Installs the dependencies, builds the program and meshes the three-component wing into out/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=$PWD/out

scripts/install_dependencies.sh
. scripts/build.sh
build_quietly -- quadrille

mkdir -p "$out"
picture=$out/wing.svg
! command -v rsvg-convert >/dev/null || picture=$out/wing.png
build/bin/quadrille quad examples/data/three_component_wing.geo -o "$out/wing.msh" -o "$out/wing.vtk" \
  --field "$out/wing_field.vtu" --picture "$picture" --json "$out/wing.json"
build/bin/quadrille check "$out/wing.msh" --against examples/data/three_component_wing.geo

echo
echo "The three-component wing as quadrilaterals:"
echo "  mesh     $out/wing.msh (Gmsh 4.1, with the physical groups), $out/wing.vtk"
echo "  field    $out/wing_field.vtu"
echo "  picture  $picture"
echo "  summary  $out/wing.json"
