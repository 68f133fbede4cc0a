#!/usr/bin/env bash
# Builds the archive (scripts/archive.sh) and of it the image of the service, starts it, and runs a job through it, with
# whichever builder is here: a docker daemon, or buildah and podman without any daemon. Each step is printed.
#   scripts/image.sh
# JOBS=n compiles that many files at a time. BASE=image sets the base (debian:bookworm-slim). Without a network to a registry, and
# with mmdebstrap, that base is made of the packages that apt of this machine can install. PORT=n sets the port (18080).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
port="${PORT:-18080}"
name=snapthrough-image-test

step() { echo "== $*" >&2; "$@"; }

with_docker() {
  step docker build --build-arg "BASE=${BASE:-debian:bookworm-slim}" -f docker/Dockerfile -t snapthrough .
  step docker run -d --rm --name "$name" --network host --read-only --tmpfs /tmp --cap-drop ALL \
    --security-opt no-new-privileges -v "$name:/data" -e "SNAPTHROUGH_LISTEN=127.0.0.1:$port" snapthrough
  trap 'docker stop -t 15 "$name" >/dev/null' EXIT
}

# A Debian base image without a registry.
make_base() {
  local root apt
  root="$(mktemp -d)"
  apt="${APT_SOURCES:-/etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources}"
  # shellcheck disable=SC2012,SC2046,SC2086
  step mmdebstrap --variant=minbase --quiet bookworm "$root/base.tar" $(ls -d $apt 2>/dev/null)
  local container
  container="$(step buildah from scratch)"
  step buildah add "$container" "$root/base.tar" / >/dev/null
  step buildah commit "$container" localhost/debian:bookworm-slim >/dev/null
  step buildah rm "$container" >/dev/null
  rm -rf "$root"
}

with_buildah() {
  if ! buildah inspect --type image localhost/debian:bookworm-slim >/dev/null 2>&1 && [ -z "${BASE:-}" ]; then
    make_base
  fi
  step buildah build --isolation chroot --network host --pull-never --format docker --layers \
    --build-arg "BASE=${BASE:-localhost/debian:bookworm-slim}" -f docker/Dockerfile -t localhost/snapthrough .
  step podman --runtime runc run -d --rm --name "$name" --network host --ulimit nofile=20000:20000 \
    --ulimit nproc=20000:20000 --no-healthcheck --read-only --tmpfs /tmp --cap-drop ALL \
    --security-opt no-new-privileges -v "$name:/data" -e "SNAPTHROUGH_LISTEN=127.0.0.1:$port" localhost/snapthrough
  trap 'podman stop -t 15 "$name" >/dev/null' EXIT
}

use_it() {
  local url="http://127.0.0.1:$port"
  for _ in $(seq 50); do
    curl -fsS "$url/readyz" >/dev/null 2>&1 && break
    sleep 0.2
  done
  step curl -fsS "$url/readyz"
  echo
  step curl -fsS -H 'Content-Type: application/json' --data-binary @examples/arch_outside_base_k1e7.json \
    -o build/image_result.json "$url/v1/jobs"
  jq -c .summary build/image_result.json
}

mkdir -p build
step bash scripts/archive.sh
if command -v docker >/dev/null && docker info >/dev/null 2>&1; then
  with_docker
elif command -v buildah >/dev/null && command -v podman >/dev/null; then
  with_buildah
else
  echo "Neither a docker daemon nor buildah with podman is here (apt-get install buildah podman runc mmdebstrap)." >&2
  exit 1
fi
use_it
echo "== the image works"
