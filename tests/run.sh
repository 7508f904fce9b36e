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

export XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-$(mktemp -d)}
export WGPU_BACKEND=vulkan # window tests compare pictures of one driver

step() {
    echo "── $*"
    "$@"
}
step cargo fmt --check
step cargo clippy --all-targets -- -D warnings
step cargo clippy --no-default-features --all-targets -- -D warnings
step env RUSTDOCFLAGS="-D warnings" cargo doc --no-deps --quiet
step cargo test
# Whatever does not show a window is the same code: one run of the command line is enough, and
# compiling it for speed would take longer than running it.
step env CARGO_PROFILE_DEV_OPT_LEVEL=0 cargo build --no-default-features
windowless=$(mktemp -d)
trap 'rm -rf "$windowless"' EXIT
cp "${CARGO_TARGET_DIR:-target}/debug/bspscope" "$windowless"
step env BSPSCOPE="$windowless/bspscope" cargo test --test cli
echo "all passed"
