"""Makes the pictures that commands of documents draw, by the commands as they stand there: figure_commands.py SNAPTHROUGH."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FENCE = re.compile(r"^```(\w*) ?(\S*)\n(.*?)^```", re.MULTILINE | re.DOTALL)  # kind, name, text
# document: {file that its commands draw: picture under docs}
DRAWN = {"docs/tutorial.md": {"mode.svg": "docs/tutorial_mode.svg", "chart.svg": "docs/tutorial_chart.svg"},
         "docs/howto/plot-results.md": {"pipe_path.svg": "docs/howto/plots/pipe_path.svg",
                                        "pipe_shape.svg": "docs/howto/plots/pipe_shape.svg",
                                        "pile_laws.svg": "docs/howto/plots/pile_laws.svg"},
         "docs/howto/monopile.md": {"monopile_moment.svg": "docs/howto/monopile_moment.svg"}}


def run_blocks(program, text, wanted, folder):
    """Writes the files of a document ("json NAME") and runs its blocks that draw a wanted file."""
    (folder / "bin").mkdir()
    (folder / "bin" / "snapthrough").symlink_to(program)
    (folder / "examples").symlink_to(ROOT / "examples")
    environment = {**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}"}
    for kind, name, block in FENCE.findall(text):
        if kind == "json" and name:
            (folder / name).write_text(block, encoding="utf-8")
        elif kind in ("", "sh") and any(f"-o {file}" in block for file in wanted):
            lines = "".join(line for line in block.splitlines(keepends=True) if not line.startswith("export PATH="))
            subprocess.run(["bash", "-e", "-o", "pipefail", "-c", lines], cwd=folder, env=environment, check=True,
                           stdout=subprocess.DEVNULL)


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    for document, drawn in DRAWN.items():
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            run_blocks(program, (ROOT / document).read_text(encoding="utf-8"), drawn, folder)
            for file, picture in drawn.items():
                shutil.copyfile(folder / file, ROOT / picture)


if __name__ == "__main__":
    main()
