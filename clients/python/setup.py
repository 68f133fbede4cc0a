"""Makes the parts of the package that follow the contract, and puts libsnapthrough into it.

The library is, the first that is there:
- those that PYTHONSNAPTHROUGH_LIBRARIES names, as FOLDER=FILE;... (scripts/wheel.sh): a folder is named by what a processor
  must have (x86-64-v2, x86-64-v3, any);
- build/release/libsnapthrough.so.1 of the checkout;
- a new build in build/python of the checkout, by CMake;
- none, where PYTHONSNAPTHROUGH_LIBRARIES is "none", or the sources of the library are not there: such a package asks a service,
  finds a library that is installed, or runs in a browser (Pyodide), where the page gives it the solver.

PYTHONSNAPTHROUGH_PLATFORM names the platform of a wheel whose libraries run elsewhere, such as manylinux_2_17_x86_64 or win_amd64.
"""
import os
import pathlib
import shutil
import subprocess
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # setuptools before 70
    from wheel.bdist_wheel import bdist_wheel

FOLDER = pathlib.Path(__file__).resolve().parent
ROOT = FOLDER.parent.parent
NAME = "libsnapthrough.so.1"
NAME_ON_WINDOWS = "snapthrough.dll"
VARIABLE = "PYTHONSNAPTHROUGH_LIBRARIES"


def given_libraries():
    """(folder, file) of the libraries that the environment names."""
    pairs = filter(None, os.environ.get(VARIABLE, "").split(";"))
    return [(folder, pathlib.Path(file)) for folder, _, file in (pair.partition("=") for pair in pairs)]


def built_library():
    """The library, built by CMake; what is missing for that ends the program."""
    build = ROOT / "build" / "python"
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DSNAPTHROUGH_PARTS=library", "-DSNAPTHROUGH_WERROR=OFF"]
    if shutil.which("ninja"):
        options += ["-G", "Ninja"]
    steps = [["cmake", "-S", str(ROOT), "-B", str(build), *options],
             ["cmake", "--build", str(build), "--target", "snapthrough_shared", "--parallel", str(os.cpu_count() or 1)]]
    for step in steps:
        try:
            subprocess.run(step, check=True)
        except (OSError, subprocess.CalledProcessError) as problem:
            sys.exit(f"libsnapthrough could not be built: {problem}\nIt needs CMake 3.25, a compiler of C++20, Eigen 3.4 and "
                     "nlohmann_json 3.11 (Debian: cmake g++ libeigen3-dev nlohmann-json3-dev).")
    return build / NAME


def brings_libraries():
    """Whether the package has libraries inside."""
    if os.environ.get(VARIABLE) == "none":
        return False
    return bool(given_libraries()) or (ROOT / "clients" / "c" / "snapthrough.map").is_file()


def libraries():
    """(folder, file) of the libraries that the package brings."""
    if not brings_libraries():
        return []
    given = given_libraries()
    if given:
        return given
    ready = ROOT / "build" / "release" / NAME
    return [("any", ready if ready.is_file() else built_library())]


class BuildWithLibraries(build_py):
    """Copies the libraries into the package."""

    def run(self):
        super().run()
        if self.editable_mode:
            return  # the package finds the library in the checkout
        for folder, file in libraries():
            target = pathlib.Path(self.build_lib, "snapthrough", "native", folder)
            target.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, target / (NAME_ON_WINDOWS if file.suffix == ".dll" else NAME))

    editable_mode = False


class Wheel(bdist_wheel):
    """A wheel for every Python 3, and for one platform where it brings a library: ctypes calls that."""

    def get_tag(self):
        return "py3", "none", os.environ.get("PYTHONSNAPTHROUGH_PLATFORM") or super().get_tag()[2]


class Package(Distribution):
    """Goes where packages with compiled parts go, if it has some."""

    def has_ext_modules(self):
        return brings_libraries()


if (ROOT / "api" / "openapi" / "openapi.json").is_file():
    subprocess.run([sys.executable, str(FOLDER / "generate.py")], check=True)
elif not (FOLDER / "snapthrough" / "results.py").is_file():
    sys.exit("snapthrough/results.py is not there: run generate.py in a checkout of the project")
setup(distclass=Package, cmdclass={"build_py": BuildWithLibraries, "bdist_wheel": Wheel})
