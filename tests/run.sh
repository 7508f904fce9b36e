#!/usr/bin/env bash
# Passes every test: formatting, lints, documentation, tests with and without the window.
# Installs the software graphics driver and the virtual display on Debian where they are missing.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(gcc libc6-dev libx11-6 libx11-xcb1 libxcursor1 libxi6 libxkbcommon-x11-0
          libvulkan1 mesa-vulkan-drivers xvfb)
missing=()
if command -v dpkg-query >/dev/null; then
    for package in "${packages[@]}"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
fi
if [ ${#missing[@]} -gt 0 ]; then
    echo "installing ${missing[*]}"
    as_root=$([ "$(id -u)" = 0 ] || echo sudo)
    $as_root apt-get update -qq
    DEBIAN_FRONTEND=noninteractive $as_root apt-get install -y -qq --no-install-recommends "${missing[@]}"
fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-$scratch}
export WGPU_BACKEND=vulkan # window tests compare pictures of one driver
export CARGO_INCREMENTAL=0 # halves the target folder, and everything is built once

step() {
    echo "── $*"
    "$@"
}
step cargo fmt --check
step cargo clippy --all-targets -- -D warnings
step env RUSTDOCFLAGS="-D warnings" cargo doc --no-deps --quiet
step cargo test
# Without the window the library is the same code. So only its lints and the command line are left,
# and compiling them for speed would take longer than running them. Naming a test makes Cargo resolve
# the features of all dependencies as above, so that none is built again.
step cargo clippy --no-default-features --lib --bins --test cli -- -D warnings
step env CARGO_PROFILE_DEV_OPT_LEVEL=0 cargo test --no-default-features --test cli
echo "all passed"
