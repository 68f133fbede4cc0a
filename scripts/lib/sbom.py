#!/usr/bin/env python3
"""Lists what an archive of the program has inside, as a CycloneDX document, and copies the terms of each part.

  sbom.py NAME VERSION FOLDER    writes FOLDER/sbom.cdx.json and FOLDER/licences/

The list has the libraries of FOLDER/lib, with package, source and version as dpkg tells them, and the libraries that consist of
headers, which are compiled into the program.
"""
import hashlib
import json
import pathlib
import shutil
import subprocess
import sys

COMPILED_IN = ("libeigen3-dev", "nlohmann-json3-dev", "libcli11-dev")  # packages of libraries that consist of headers


def told(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def package_of(library):
    """The package that brought a library of the system."""
    real = pathlib.Path(told("ldconfig", "-p").split(f"\t{library} ")[1].split("=> ")[1].split("\n")[0]).resolve()
    for path in (str(real), str(real).removeprefix("/usr")):
        done = subprocess.run(["dpkg", "-S", path], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return done.stdout.split(":")[0]
    raise SystemExit(f"no package has {real}")


def component(package, folder, files):
    fields = told("dpkg-query", "-W", "-f", "${source:Package}\t${Version}\t${Homepage}", package).split("\t")
    terms = folder / "licences" / f"{package}.txt"
    shutil.copyfile(f"/usr/share/doc/{package}/copyright", terms)
    entry = {"type": "library", "bom-ref": package, "name": package, "version": fields[1],
             "purl": f"pkg:deb/debian/{package}@{fields[1]}?arch=amd64",
             "properties": [{"name": "source", "value": fields[0]}, {"name": "terms", "value": f"licences/{package}.txt"}]}
    if len(fields) > 2 and fields[2]:
        entry["externalReferences"] = [{"type": "website", "url": fields[2]}]
    if files:
        entry["components"] = [{"type": "file", "name": f"lib/{file.name}",
                                "hashes": [{"alg": "SHA-256", "content": hashlib.sha256(file.read_bytes()).hexdigest()}]}
                               for file in files]
    return entry


def main():
    name, version, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    (folder / "licences").mkdir(exist_ok=True)
    by_package = {package: [] for package in COMPILED_IN}
    for file in sorted((folder / "lib").iterdir()):
        if not file.name.startswith("snapthrough-"):
            by_package.setdefault(package_of(file.name), []).append(file)
    document = {"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
                "metadata": {"component": {"type": "application", "bom-ref": name, "name": "snapthrough", "version": version,
                                           "licenses": [{"license": {"id": "MIT"}}]}},
                "components": [component(package, folder, files) for package, files in sorted(by_package.items())]}
    (folder / "sbom.cdx.json").write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    print(f"{len(document['components'])} parts in sbom.cdx.json")


if __name__ == "__main__":
    main()
