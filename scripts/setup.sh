#!/usr/bin/env bash
# Installs every package that the build, the tests and the demo use, on Debian 12. Does nothing if all are there.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config ccache clang-format
  libpcl-dev libeigen3-dev libflann-dev liblz4-dev zlib1g-dev libcli11-dev
  libgtest-dev libbenchmark-dev
  xvfb xauth libgl1-mesa-dri
)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "setup.sh: ${missing[*]} are missing; run this as root, or install sudo" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
