#!/usr/bin/env python3
"""Checks that every relative link of the documents leads to a file of the repository, and to a heading where it
names one.

  check_links.py              exit status 1 names the links that lead nowhere
  check_links.py --self-test  checks the checker
"""
import pathlib
import re
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FENCE = re.compile(r"^ {0,3}(```|~~~).*?^ {0,3}\1[^\n]*$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\[[^\]\n]*\]\(\s*<?([^)\s>]+)>?[^)\n]*\)")
HEADING = re.compile(r"^#{1,6}\s+(.+?)\s*#*$", re.MULTILINE)


def anchors(text):
    """Names of the headings, as they are on GitHub."""
    names = set()
    for heading in HEADING.findall(FENCE.sub("", text)):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        names.add(re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-"))
    return names


def broken_links(document, root):
    """(link, why) of each link of a file that leads nowhere."""
    text = FENCE.sub("", document.read_text(encoding="utf-8"))
    for link in LINK.findall(text):
        if re.match(r"[a-z][a-z0-9+.-]*:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (document.parent / path).resolve() if path else document
        if not target.exists():
            yield link, "there is no such file"
        elif root not in (target, *target.parents):
            yield link, "it leaves the repository"
        elif anchor and target.suffix == ".md" and anchor not in anchors(target.read_text(encoding="utf-8")):
            yield link, "there is no such heading"


def check(root, documents):
    found = 0
    for document in documents:
        for link, why in broken_links(document, root):
            print(f"{document.relative_to(root)}: {link}: {why}")
            found += 1
    return found


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder).resolve()
        (root / "b.md").write_text("# A `b` heading, twice\n")
        page = root / "a.md"
        page.write_text("[b](b.md) [c](b.md#a-b-heading-twice) [web](https://example.org/x) [self](#top)\n# Top\n"
                        "```\n[code](none.md)\n```\n")
        assert check(root, [page]) == 0
        page.write_text("[x](none.md) [y](b.md#nowhere) [z](../z.md)\n")
        assert len(list(broken_links(page, root))) == 3
    print("check_links: self-test passed")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    # What stands in examples/ is published in docs/thesis, and its links are those of a page there.
    patterns = ("*.md", "bench/*.md", "docs/**/*.md")
    names = [str(path.relative_to(ROOT)) for pattern in patterns for path in sorted(ROOT.glob(pattern))]
    found = check(ROOT, [ROOT / name for name in names])
    print(f"check_links: {len(names)} documents, {found} links that lead nowhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
