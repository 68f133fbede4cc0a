"""Makes the parts of the package that follow the contract; an archive of the sources has them without the contract."""
import pathlib
import subprocess
import sys

from setuptools import setup

FOLDER = pathlib.Path(__file__).resolve().parent
if (FOLDER.parent.parent / "api" / "openapi" / "openapi.json").is_file():
    subprocess.run([sys.executable, str(FOLDER / "generate.py")], check=True)
elif not (FOLDER / "snapthrough" / "results.py").is_file():
    sys.exit("snapthrough/results.py is not there: run generate.py in a checkout of the project")
setup()
