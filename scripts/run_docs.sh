#!/usr/bin/env bash
# Runs the commands of one page of the documents in an empty folder: every block that opens with ```sh run, in order.
#   scripts/run_docs.sh KAPPA PAGE     KAPPA: the program, PAGE: a Markdown file
# The commands find the program as kappa and the clouds of the repository in $KAPPA_CLOUDS. The first block that fails
# is printed and ends the script with exit code 1, as does a page without such a block.
set -euo pipefail

if [ $# -ne 2 ] || [ ! -x "$1" ] || [ ! -f "$2" ]; then
  echo "usage: scripts/run_docs.sh KAPPA PAGE" >&2
  exit 2
fi
root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
page=$(readlink -f "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/blocks" "$work/empty"
ln -s "$(readlink -f "$1")" "$work/bin/kappa"

# One file a block, named by the line that it begins on.
awk -v folder="$work/blocks" '
  /^```sh run[ \t]*$/ { if (file) exit 1; file = sprintf("%s/%05d", folder, NR + 1); printf "" > file; next }
  /^```/ && file      { close(file); file = ""; next }
  file                { print > file }
  END                 { if (file) exit 1 }' "$page" || {
  echo "$page: a block that opens with \`\`\`sh run is not closed" >&2
  exit 1
}

export PATH="$work/bin:$PATH" KAPPA_CLOUDS="$root/clouds"
cd "$work/empty"
count=0
for block in "$work"/blocks/*; do
  [ -e "$block" ] || break
  count=$((count + 1))
  if ! bash -euo pipefail "$block" >"$work/output" 2>&1; then
    echo "$page:$((10#$(basename "$block"))): this block fails" >&2
    sed 's/^/    /' "$block" >&2
    echo "its output:" >&2
    sed 's/^/    /' "$work/output" >&2
    exit 1
  fi
done
if [ "$count" -eq 0 ]; then
  echo "$page: no block opens with \`\`\`sh run" >&2
  exit 1
fi
echo "$page: $count blocks run"
