# shellcheck shell=bash
# shellcheck disable=SC2034
# Package lists of the scripts and how they are installed. Sourced, not run.

# What configuring and building needs, tests and benchmarks included: a build folder has one set of options.
BUILD_PACKAGES=(g++ cmake ninja-build pkg-config libeigen3-dev nlohmann-json3-dev libcpp-httplib-dev libssl-dev
  zlib1g-dev libbrotli-dev libsqlite3-dev libpq-dev libzstd-dev libspdlog-dev libfmt-dev libcli11-dev libtomlplusplus-dev
  libgtest-dev libgmock-dev libbenchmark-dev)
# What scripts/run.sh needs besides, to talk to the service.
RUN_PACKAGES=(curl jq)
# What scripts/test.sh needs besides.
TEST_PACKAGES=(valgrind clang-format python3 postgresql-15 procps
  abigail-tools librsvg2-bin libreoffice-calc-nogui python3-uno man-db mandoc fish zsh openssl octave-dev codespell
  python3-numpy)
# What scripts/schema.sh needs; not installed where another installation of node and npm is there.
SCHEMA_PACKAGES=(nodejs npm)
# What scripts/web_test.sh and scripts/web_pictures.sh need besides, where no other Chromium is there.
PAGE_PACKAGES=(chromium fonts-dejavu-core)
# What scripts/report.sh and scripts/bench.sh need besides.
REPORT_PACKAGES=(python3)
# What scripts/figures.sh needs besides, to draw the figures of the theory and to run commands of documents.
FIGURE_PACKAGES=(python3-numpy jq librsvg2-bin)

# What scripts/wasm.sh needs, beside BUILD_PACKAGES and nodejs.
WASM_PACKAGES=(clang-19 lld-19 llvm-19 libc++-19-dev-wasm32 libc++abi-19-dev-wasm32 libclang-rt-19-dev-wasm32 wasi-libc)

# missing_packages NAME...: prints those that are not installed, one a line.
missing_packages() {
  local name
  for name in "$@"; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" != installed ]; then
      echo "$name"
    fi
  done
}

# install_packages NAME...: installs what is missing; does nothing at all when everything is there.
install_packages() {
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  if [ "${#missing[@]}" -eq 0 ]; then
    return 0
  fi
  if ! command -v apt-get >/dev/null; then
    echo "This script installs packages with apt-get, which is not here. Please install: ${missing[*]}" >&2
    return 1
  fi
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "Missing packages: ${missing[*]}" >&2
      echo "Install them as root (apt-get install ${missing[*]}), or run this script as root." >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends \
    "${missing[@]}" >/dev/null
}
