#!/bin/sh
# usage: tests/web/figures/make_cases.sh build/release/snapthrough
# Computes the results beside the requests of tests/web/figures/cases again.
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")/cases"
for request in *.request.json; do
  "$program" solve "$request" > "${request%.request.json}.result.json"
done
for sweep in *.sweep.json; do
  "$program" sweep "$sweep" > "${sweep%.sweep.json}.table.json" || [ $? -eq 3 ]  # some points are to fail
done
