#!/usr/bin/env bash
# Makes the manual's pictures anew with the program (built before), ImageMagick and rsvg-convert.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=build/bin/quadrille
[ -x "$program" ] || { echo "there is no $program; build it first (scripts/test.sh)" >&2; exit 1; }
command -v convert >/dev/null || { echo "ImageMagick's convert is needed (package imagemagick)" >&2; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# figure <case> <panel: 0 field, 1 map, 2 layout, 3 mesh> <width> <file> [options of quadrille quad]
figure() {
  [ -f "$folder/$1.png" ] ||
    "$program" quad "examples/data/$1.geo" -o "$folder/$1.msh" --picture "$folder/$1.png" --quiet "${@:5}"
  mkdir -p "$(dirname "$4")"
  convert "$folder/$1.png" -crop 2x2@ +repage "$folder/panel_%d.png"
  convert "$folder/panel_$2.png" -resize "$3x" -colors 32 -strip "$4"
  echo "$4"
}

figure three_component_wing 0 800 doc/Odeco_frame_field/fig/wing_field.png
figure square_1_10 0 500 doc/Odeco_frame_field/fig/square_field.png
figure disk_feature 3 500 doc/Odeco_frame_field/fig/disk_feature.png \
  --anisotropic --size boundary=0.15x1.5 --size feature=0.15x1.5
figure square_1_2 3 500 doc/Odeco_frame_field/fig/metric.png --anisotropic --size-field examples/data/metric.txt
figure three_component_wing 1 800 doc/Seamless_parametrization/fig/wing_map.png
figure nautilus 2 600 doc/Quad_extraction/fig/nautilus_layout.png
figure nautilus 3 600 doc/Quad_extraction/fig/nautilus_mesh.png
figure three_component_wing 3 940 doc/fig/wing_mesh.png

"$program" quad examples/data/arch.geo -o "$folder/arch.msh" --picture "$folder/arch.svg" --quiet
rsvg-convert -w 560 "$folder/arch.svg" -o doc/Quad_extraction/fig/arch_quads.png
echo doc/Quad_extraction/fig/arch_quads.png

for case in ball notched_block bracket; do
  file=doc/Volumetric_cross_field/fig/$case.png
  "$program" cross "examples/data/$case.geo" --tet-size 0.1 -o "$folder/$case.vtu" --picture "$folder/$case.svg" --quiet
  rsvg-convert -w 560 "$folder/$case.svg" -o "$file"
  echo "$file"
done
