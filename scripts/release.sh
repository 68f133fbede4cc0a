#!/usr/bin/env bash
# Builds what a release consists of into dist/, tries each part, writes SHA256SUMS and says where each file is published.
#   scripts/release.sh
# Nothing is published: that needs the accounts of the project.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [ -n "$(git status --porcelain)" ]; then
  echo "Files differ from the commit: a release is made of a commit." >&2
  exit 1
fi

rm -rf dist
bash scripts/archive.sh
bash scripts/archive_test.sh dist/snapthrough-*-linux-x86_64.tar.gz
bash scripts/wheel.sh x86_64
bash scripts/wheel.sh aarch64
bash scripts/wheel.sh windows
bash scripts/wasm.sh
bash scripts/wheel.sh none
(cd build/wasm/package && npm pack --silent --pack-destination ../../../dist >/dev/null)
bash scripts/package.sh
cp build/package/packages/*.deb dist/
(cd dist && sha256sum -- * >SHA256SUMS)

cat dist/SHA256SUMS
cat <<'TEXT'

| what | how it is published |
| --- | --- |
| *.whl | twine upload dist/*.whl |
| snapthrough-solver-*.tgz | npm publish dist/snapthrough-solver-*.tgz |
| *.tar.gz, *.deb, SHA256SUMS | as files of the tag's release |
| the image | scripts/image.sh makes it of the archive; push it to a registry of images |
| the page without a service | scripts/site.sh FOLDER; copy the folder to a file server |
TEXT
