#!/usr/bin/env bash
# Fuzzes the reader of requests, the HTTP front and the C interface, each for SECONDS (600), and adds the inputs that
# reach new code to tests/fuzz/corpus/*.tar.gz.
#   [TARGETS="request http library"] scripts/fuzz.sh [SECONDS]      needs clang 16 (clang-16, libclang-rt-16-dev)
#   scripts/fuzz.sh pack FOLDER        packs the inputs of FOLDER, named request or http, into its archive
# tar -xzf tests/fuzz/corpus/http.tar.gz unpacks an archive; tar -xzOf ARCHIVE http/NAME prints one input.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# pack FOLDER: the archive is the same for the same inputs.
pack() {
  tar -C "$(dirname "$1")" --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX --format=ustar \
    -cf - "$(basename "$1")" | gzip -9n >"tests/fuzz/corpus/$(basename "$1").tar.gz"
}

if [ "${1:-}" = pack ]; then
  pack "$2"
  exit
fi
seconds="${1:-600}"
read -ra targets <<<"${TARGETS:-request http library}"
build=build/fuzz
cmake -S . -B "$build" -G Ninja -DCMAKE_C_COMPILER=clang-16 -DCMAKE_CXX_COMPILER=clang++-16 -DCMAKE_BUILD_TYPE=Release \
  -DSNAPTHROUGH_FUZZ=ON -DSNAPTHROUGH_BENCH=OFF -DSNAPTHROUGH_WERROR=OFF \
  -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DSNAPTHROUGH_SANITIZE= >/dev/null
cmake --build "$build" --parallel "${JOBS:-$(nproc)}" --target "${targets[@]/#/fuzz_}"
for target in "${targets[@]}"; do
  documents="${target/library/request}"  # both take documents
  corpus="$build/tests/fuzz/corpus/$documents"  # where the configuration has unpacked the archive
  more=()
  if [ "$target" = library ]; then
    more=(tests/clients/requests)  # that are solved
  fi
  found="$build/found_$target"
  mkdir -p "$found"
  "$build/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -max_len=8192 -timeout=10 -rss_limit_mb=2048 \
    -dict="tests/fuzz/$documents.dict" -print_final_stats=1 -artifact_prefix="$build/" "$found" "$corpus" \
    "${more[@]}" 2>&1 | tail -12
  "$build/tests/fuzz/fuzz_$target" -use_counters=0 -set_cover_merge=1 "$corpus" "$found" 2>&1 | tail -1
  pack "$corpus"
done
