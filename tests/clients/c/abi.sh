#!/usr/bin/env bash
# Compares the symbols and types of libsnapthrough.so with those that were published: programs that were linked with
# an earlier build must run with a later one.
#   abi.sh LIBRARY SOURCE [--write]      --write takes the interface of LIBRARY as the published one
set -euo pipefail
library="$1"
source="$2"
published="$source/clients/c/abi/libsnapthrough.so.1.abi"
map="$source/clients/c/snapthrough.map"

if [ "${3:-}" = --write ]; then
  abidw --exported-interfaces-only --no-corpus-path --no-comp-dir-path --no-show-locs --headers-dir "$source/clients/c" \
    --drop-private-types --out-file "$published" "$library"
  exit
fi

documented="$(sed -n 's/^ *\(snapthrough_[a-z_]*\);$/\1/p' "$map" | sort)"
exported="$(nm -D --defined-only --without-symbol-versions "$library" | awk '$2 != "A" {print $3}' | sort)"
if [ "$documented" != "$exported" ]; then
  echo "exported symbols are not those of $map:"
  diff <(echo "$documented") <(echo "$exported")
  exit 1
fi
# New functions may come; functions and types that programs use stay as they are.
abidiff --harmless --no-added-syms "$published" "$library" && echo "the interface is the published one"
