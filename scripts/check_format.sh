#!/usr/bin/env bash
# Checks that all C++ files are formatted as .clang-format says; with --fix formats them. Exit code 77 (for ctest:
# skipped) where clang-format is not installed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! command -v clang-format >/dev/null; then
  echo "clang-format is not installed; nothing was checked"
  exit 77
fi

files=()
while IFS= read -r -d '' file; do
  [ ! -f "$file" ] || files+=("$file")
done < <(
  if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    git ls-files -z --cached --others --exclude-standard -- '*.h' '*.cpp'
  else
    find . -path './build*' -prune -o \( -name '*.h' -o -name '*.cpp' \) -print0
  fi
)
if [ ${#files[@]} -eq 0 ]; then
  echo "there is nothing to check"
  exit 0
fi

if [ "${1:-}" = --fix ]; then
  clang-format -i "${files[@]}"
else
  clang-format --dry-run -Werror --ferror-limit=1 "${files[@]}"
fi
echo "${#files[@]} files are formatted"
