#!/usr/bin/env python3
"""Runs the commands of the documents' code blocks that analyse something of examples/, and compares requests with answers.

  check_code_blocks.py SNAPTHROUGH   exit status 1 names the commands that fail, and the answers that are others
  check_code_blocks.py --self-test   checks the checker

A command is a line of a fenced block that begins with snapthrough check, solve, sweep, plot, convert or merge ("$ " may stand before
it, build/release/ too). It runs when it names a file of examples/, or one that an earlier command of its document has written; the
commands of a document share a folder like that of the project, in which build/release/snapthrough is. Each runs as it stands, in a
fresh shell, which finds the program by its name where the document has the line of PATH_LINE, and not otherwise. A block that
holds an "analysis" and is followed by a block that holds a "summary" is a request with its answer: each value of that summary is
the program's, numbers to 1e-8.

A document with a block "json NAME" is a tutorial and is followed: such a block is written to the file NAME, sh and python blocks
run in their order beside a service, whose port replaces 8080, and a text block after one is what it prints, numbers to 1e-8.
"""
import contextlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
DOCUMENTS = ("README.md", "docs/*.md", "docs/gallery/*.md", "docs/howto/*.md")
FENCE = re.compile(r"^```\w*(?: \S+)?\n(.*?)^```", re.MULTILINE | re.DOTALL)
KIND_FENCE = re.compile(r"^```(\w*) ?(\S*)\n(.*?)^```", re.MULTILINE | re.DOTALL)  # kind, name, text
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
COMMAND = re.compile(r"^(?:\$ )?(?:build/release/)?snapthrough (?:check|solve|sweep|plot|convert|merge) ")
PATH_LINE = 'export PATH="$PWD/build/release:$PATH"'
SAME_NUMBER = 1e-8
MINIMUM_RUN = 20  # so that a changed style of writing cannot empty the check


def commands(text):
    """Command lines of the fenced blocks, without prompts and comments."""
    for block in FENCE.findall(text):
        for line in block.splitlines():
            if COMMAND.match(line):
                yield re.sub(r"\s+#.*", "", line.removeprefix("$ "))


def is_complete(command, folder):
    """Whether a command names a file that is there."""
    return any((folder / word).is_file() for word in command.split()[1:])


def run_commands(program, text, folder):
    """(commands run, mistakes) of one document."""
    (folder / "examples").symlink_to(ROOT / "examples")
    (folder / "build" / "release").mkdir(parents=True)
    (folder / "build" / "release" / "snapthrough").symlink_to(pathlib.Path(program).resolve())
    run, wrong = 0, []
    before = f"{PATH_LINE}; " if PATH_LINE in text else ""
    for command in commands(text):
        if is_complete(command, folder):
            run += 1
            done = subprocess.run(["bash", "-o", "pipefail", "-c", before + command], cwd=folder, capture_output=True, text=True,
                                  check=False)
            if done.returncode != 0:
                wrong.append(f"{command}: exit status {done.returncode}: {done.stderr.strip()[-200:]}")
    return run, wrong


def answers(text):
    """(request, summary) of each block with an analysis that a block with a summary follows."""
    blocks = []
    for block in FENCE.findall(text):
        try:
            blocks.append(json.loads(block))
        except ValueError:
            blocks.append(None)
    for request, answer in zip(blocks, blocks[1:]):
        if isinstance(request, dict) and isinstance(answer, dict) and "analysis" in request and "summary" in answer:
            yield request, answer["summary"]


def same(ours, printed):
    if isinstance(printed, float):
        return isinstance(ours, float) and abs(ours - printed) <= SAME_NUMBER * max(1.0, abs(printed))
    return ours == printed


def wrong_answers(program, text):
    for request, summary in answers(text):
        done = subprocess.run([program, "solve", "-"], input=json.dumps(request), capture_output=True, text=True, check=False)
        ours = json.loads(done.stdout)["summary"] if done.returncode == 0 else {}
        for field, printed in summary.items():
            if not same(ours.get(field), printed):
                yield f"summary.{field} is {ours.get(field)}, not {printed}"


@contextlib.contextmanager
def service(program, folder):
    """A service with an empty store; gives its port."""
    command = [program, "serve", "--listen", "127.0.0.1:0", "--store", folder / "store.db", "--no-web"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        try:
            lines = (json.loads(line) for line in process.stderr)
            yield next(line["port"] for line in lines if line["event"] == "listening")
        finally:
            process.terminate()
            process.stderr.read()


def same_text(ours, printed):
    """Whether the words are the same, and numbers nearly."""
    numbers = zip(map(float, NUMBER.findall(ours)), map(float, NUMBER.findall(printed)))
    return (NUMBER.sub("#", ours).split() == NUMBER.sub("#", printed).split()
            and all(abs(a - b) <= SAME_NUMBER * max(1.0, abs(b)) for a, b in numbers))


def follow(program, text, folder):
    """(blocks run, mistakes) of a tutorial; none of another document."""
    blocks = KIND_FENCE.findall(text)
    if not any(kind == "json" and name for kind, name, _ in blocks):
        return 0, []
    subprocess.run([sys.executable, ROOT / "clients/python/generate.py"], check=True, stdout=subprocess.DEVNULL)
    path = f"{folder}/build/release:{os.environ['PATH']}" if PATH_LINE in text else os.environ["PATH"]
    environment = {**os.environ, "PATH": path, "PYTHONPATH": str(ROOT / "clients/python")}
    run, wrong, printed = 0, [], ""
    with service(program, folder) as port:
        for kind, name, block in blocks:
            if kind == "json" and name:
                (folder / name).write_text(block, encoding="utf-8")
            elif kind in ("sh", "python"):
                run += 1
                command = ["bash", "-e", "-o", "pipefail"] if kind == "sh" else [sys.executable, "-"]
                done = subprocess.run(command, input=block.replace(":8080", f":{port}"), cwd=folder, env=environment,
                                      capture_output=True, text=True, check=False)
                printed = done.stdout
                if done.returncode != 0:
                    wrong.append(f"block {run}: exit status {done.returncode}: {done.stderr.strip()[-300:]}")
            elif kind == "text" and not same_text(printed, block):
                wrong.append(f"block {run} prints {printed!r}, not {block!r}")
    return run, wrong


def self_test():
    text = "```\n$ snapthrough check examples/none.json\nsnapthrough solve a.json   # why\nother\n```\nsnapthrough solve b.json\n"
    assert list(commands(text)) == ["snapthrough check examples/none.json", "snapthrough solve a.json"]
    assert not is_complete("snapthrough solve a.json", pathlib.Path("/nowhere"))
    text = '```json\n{"analysis": 1}\n```\n```json\n{"summary": {"x": 1.0}}\n```\n'
    assert list(answers(text)) == [({"analysis": 1}, {"x": 1.0})]
    assert same(1.0 + 1e-9, 1.0) and not same(1.1, 1.0) and not same(None, 1.0) and same("a", "a")
    assert same_text("a  1.0000000001\n", "a 1.0\n") and not same_text("a 1.1", "a 1.0") and not same_text("a 1 2", "a 1")
    assert KIND_FENCE.findall("```json a.json\n{}\n```\n") == [("json", "a.json", "{}\n")]
    print("check_code_blocks: self-test passed")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    run, wrong = 0, []
    for path in sorted(path for pattern in DOCUMENTS for path in ROOT.glob(pattern)):
        text = path.read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as folder:
            more, mistakes = run_commands(sys.argv[1], text, pathlib.Path(folder))
            blocks, others = follow(sys.argv[1], text, pathlib.Path(folder))
        run += more + blocks
        mistakes += others
        wrong += [f"{path.relative_to(ROOT)}: {mistake}" for mistake in mistakes + list(wrong_answers(sys.argv[1], text))]
    if run < MINIMUM_RUN:
        wrong.append(f"only {run} commands were run, {MINIMUM_RUN} were expected")
    print("\n".join(wrong + [f"check_code_blocks: {run} commands run, {len(wrong)} mistakes"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
