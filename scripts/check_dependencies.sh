#!/usr/bin/env bash
# Compares the packages that each package's headers include with those that its package_info/dependencies declares, and
# checks that nobody includes the internals of another package, Support's excepted.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=()
for description in */package_info/dependencies; do
  packages+=("${description%%/*}")
done

errors=0
complain() {
  echo "check_dependencies.sh: $*" >&2
  errors=$((errors + 1))
}

# The package that owns header Quadrille/$1, empty if there is none.
owner_of() {
  local package
  for package in "${packages[@]}"; do
    if [ -f "$package/include/Quadrille/$1" ]; then
      echo "$package"
      return
    fi
  done
}

for package in "${packages[@]}"; do
  [ -n "$(find "$package" -name '*.h' -print -quit)" ] || continue
  declared=" $(awk '{print $1}' "$package/package_info/dependencies" | tr '\n' ' ') "
  used=" "
  while IFS=: read -r file header; do
    owner=$(owner_of "$header")
    if [ -z "$owner" ]; then
      complain "$file includes <Quadrille/$header>, which does not exist"
      continue
    fi
    [ "$owner" != "$package" ] || continue
    used+="$owner "
    case "$header" in
    Support/internal/*) ;;
    */internal/*) complain "$file includes <Quadrille/$header>, which belongs to $owner alone" ;;
    esac
    [[ $declared == *" $owner "* ]] ||
      complain "$file includes <Quadrille/$header>, but $package does not declare $owner"
  done < <(grep -rHoE '^ *# *include *<Quadrille/[^>]+>' "$package/include" --include='*.h' |
    sed -E 's/: *# *include *<Quadrille\/([^>]+)>/:\1/')
  for other in "${packages[@]}"; do
    if [[ $declared == *" $other "* && $used != *" $other "* ]]; then
      complain "$package declares $other and does not include anything of it"
    fi
  done
done

[ "$errors" -eq 0 ] || exit 1
echo "dependencies of ${#packages[@]} packages are as declared"
