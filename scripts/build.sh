# Sourced by the other scripts, in the top folder of the repository.

# build_quietly [<option of cmake>...] [-- <target>...]: configures the release preset and builds the targets (default:
# all). Shows the whole output only where something fails.
build_quietly() {
  local options=() log=build/quadrille_build.log
  while [ $# -gt 0 ] && [ "$1" != -- ]; do
    options+=("$1")
    shift
  done
  [ $# -eq 0 ] || shift
  mkdir -p build
  echo "building in build/ (the first time takes some minutes) ..."
  if ! {
    cmake --preset release "${options[@]}" &&
      cmake --build --preset release --parallel "$(nproc)" ${@:+--target "$@"}
  } >"$log" 2>&1; then
    cat "$log" >&2
    echo "the build failed (see above)" >&2
    return 1
  fi
}
