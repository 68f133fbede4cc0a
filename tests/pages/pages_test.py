"""Manual pages and shell completion, as the build makes them, beside the program's own --help.

  python3 tests/pages/pages_test.py BINARY FOLDER     FOLDER: build/release/pages
Shells and man checkers that are not installed are not tried.
"""
import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BINARY = ""
FOLDER = pathlib.Path()


def output(*command, **more):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **more)


def commands():
    text = output(BINARY, "--help").stdout
    return re.findall(r"^  ([a-z]+)\s", text[text.index("Subcommands:"):], re.MULTILINE)


def options(*command):
    """Long and short names that --help lists."""
    found = set()
    for line in output(BINARY, *command, "--help").stdout.splitlines():
        if line.startswith("  -"):
            found |= {name for name in re.split(r"[ ,]", line.strip()) if re.fullmatch(r"--?[a-z][a-z-]*", name)}
    return found


def page(name):
    return gzip.decompress((FOLDER / "man1" / f"{name}.1.gz").read_bytes()).decode()


class ManualPages(unittest.TestCase):
    def test_there_is_a_page_for_each_command(self):
        names = {"snapthrough"} | {f"snapthrough-{command}" for command in commands()}
        self.assertEqual({path.name for path in (FOLDER / "man1").iterdir()}, {f"{name}.1.gz" for name in names})
        self.assertGreaterEqual(len(names), 10)

    def test_every_option_is_in_its_page(self):
        for command in [[], *([command] for command in commands())]:
            text = page("-".join(["snapthrough", *command])).replace("\\-", "-")
            bold = {name for line in text.splitlines() for name in re.findall(r"\\fB(--?[a-z-]+)\\fR", line)}
            self.assertLessEqual(options(*command), bold, command)

    def test_every_positional_argument_and_every_default_is_in_its_page(self):
        for command in commands():
            text = " ".join(page(f"snapthrough-{command}").replace("\\-", "-").split())
            help_text = output(BINARY, command, "--help").stdout
            for name in re.findall(r"^  ([a-z]+) ", help_text[:help_text.find("Options:")], re.MULTILINE):
                self.assertIn(f"\\fI{name}\\fR", text, command)
            for default in re.findall(r"^  --?[a-z-]+ [A-Z]+=(\S+)", help_text, re.MULTILINE):
                self.assertIn(f"Default: {default}", text, command)

    def test_defaults_are_those_of_any_machine(self):
        self.assertIn("Default: one for each core.", page("snapthrough-sweep"))
        self.assertIn("[one for each core]", " ".join(page("snapthrough-serve").split()))

    def test_man_and_mandoc_have_nothing_to_say(self):
        with tempfile.TemporaryDirectory() as folder:
            for path in sorted((FOLDER / "man1").iterdir()):
                plain = pathlib.Path(folder) / path.stem
                plain.write_bytes(gzip.decompress(path.read_bytes()))
                if shutil.which("man"):
                    shown = output("man", "--warnings", "-E", "UTF-8", "-l", plain)
                    self.assertEqual((shown.returncode, shown.stderr), (0, ""), path.name)
                    self.assertIn("EXIT STATUS", shown.stdout)
                if shutil.which("mandoc"):
                    found = output("mandoc", "-T", "lint", "-W", "warning", plain)
                    said = [line for line in found.stdout.splitlines() if "referenced manual not found" not in line]
                    self.assertEqual(said, [], path.name)


BASH = r"""
source "$1"
cd "$2"
shift 2
COMP_WORDS=("$@")
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
files=yes
compopt() { files=no; }
_snapthrough
printf '%s\n' "${COMPREPLY[@]}"
echo "files=$files"
"""


class Bash(unittest.TestCase):
    def complete(self, *words):
        """The words that are offered, and whether names of files are where there are none."""
        done = output("bash", "--norc", "-c", BASH, "bash", FOLDER / "bash" / "snapthrough", "/", *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = [line for line in done.stdout.splitlines() if line]
        return set(lines[:-1]), lines[-1] == "files=yes" and len(lines) == 1

    def test_commands(self):
        words, files = self.complete("snapthrough", "")
        self.assertEqual(words, set(commands()) | options())
        self.assertFalse(files)
        self.assertEqual(self.complete("snapthrough", "so")[0], {"solve"})

    def test_options_of_every_command(self):
        for command in commands():
            self.assertEqual(self.complete("snapthrough", command, "-")[0], options(command), command)
        self.assertEqual(self.complete("snapthrough", "solve", "a.json", "--ta")[0], {"--table"})

    def test_values(self):
        tables = {"points", "critical_points", "static", "buckling", "vibrations", "states"}
        self.assertEqual(self.complete("snapthrough", "solve", "--table", "")[0], tables)
        self.assertEqual(self.complete("snapthrough", "solve", "--table", "=")[0], tables)
        self.assertEqual(self.complete("snapthrough", "solve", "--table", "=", "cr")[0], {"critical_points"})
        self.assertEqual(self.complete("snapthrough", "sweep", "--threads", ""), (set(), False))

    def test_files(self):
        for words in (["solve", ""], ["solve", "--csv", "exa"], ["serve", "--config", ""], ["fetch", "-o", ""]):
            self.assertEqual(self.complete("snapthrough", *words), (set(), True), words)

    def test_readline_completes_names_of_files(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "arch one.json").touch()
            script = (f"source '{FOLDER}/bash/snapthrough'; cd '{folder}'; set +o history; bind 'set bell-style none' 2>/dev/null; "
                      "complete -p snapthrough")
            told = output("bash", "--norc", "-c", script).stdout
            self.assertIn("-o default", told)
            self.assertIn("-F _snapthrough", told)


class OtherShells(unittest.TestCase):
    @unittest.skipUnless(shutil.which("fish"), "no fish")
    def test_fish(self):
        def complete(line):
            done = output("fish", "--no-config", "-c", f"source {FOLDER}/fish/snapthrough.fish; complete -C '{line}'")
            self.assertEqual(done.stderr, "")
            return {word.split("\t")[0] for word in done.stdout.splitlines()}
        self.assertLessEqual(set(commands()), complete("snapthrough "))
        self.assertEqual(complete("snapthrough solve --table "), {"points", "critical_points", "static", "buckling", "vibrations", "states"})
        for command in commands():
            long_names = {name for name in options(command) if name.startswith("--")}
            self.assertEqual({name for name in complete(f"snapthrough {command} --") if name.startswith("--")}, long_names)

    @unittest.skipUnless(shutil.which("zsh"), "no zsh")
    def test_zsh(self):
        done = output("zsh", "-f", "-n", FOLDER / "zsh" / "_snapthrough")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        # The real completion system, in a terminal of zsh's own.
        script = (f"zmodload zsh/zpty; zpty z zsh -f -i; zpty -w z 'fpath=({FOLDER}/zsh $fpath); autoload -U compinit; "
                  "compinit -u -D; unsetopt menu_complete; LISTMAX=1000; PS1=READY; stty cols 200 rows 500'; "
                  "zpty -w -n z $'snapthrough solve --table cri\\t'; sleep 2; zpty -r z out '*critical_points*' && print found")
        done = output("zsh", "-f", "-c", script, timeout=240)
        self.assertIn("found", done.stdout, done.stdout + done.stderr)


if __name__ == "__main__":
    BINARY = str(pathlib.Path(sys.argv.pop(1)).resolve())
    FOLDER = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
