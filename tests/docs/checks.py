#!/usr/bin/python3
"""Checks that the documents and the code still agree.

    checks.py tags|includes|links|quotes ROOT

Each check returns a list of complaints, one line each with file and line; the program fails if there is any.
Python's standard library only.
"""
import re
import sys
from pathlib import Path

CODE_FOLDERS = ("libhydro", "libdynamics", "libfit", "apps", "tests", "validation")
CODE_SUFFIXES = {".hpp", ".cpp", ".py"}
SKIPPED_FOLDERS = {".git", "build", "out", "__pycache__"}

# (R3): a letter of a theory page and a number. Not after a name or a bracket, where it would be a call: f(F1).
TAG = re.compile(r"(?<![\w)\]])\(([PWRDQSFCH])(\d+)\)")
TAG_RANGE = re.compile(r"(?<![\w)\]])\(([PWRDQSFCH])(\d+)\)\s*[-–]\s*\(([PWRDQSFCH])(\d+)\)")


def files_below(root, folders, suffixes):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in suffixes and path.is_file() and not SKIPPED_FOLDERS & set(path.relative_to(root).parts):
                yield path


def tags_in(text):
    """All tags of a text; a range (R1)-(R4) stands for all from the first to the last."""
    found = {letter + number for letter, number in TAG.findall(text)}
    for letter, first, other, last in TAG_RANGE.findall(text):
        if letter == other:
            found |= {f"{letter}{n}" for n in range(int(first), int(last) + 1)}
    return found


def comment_of(line, suffix):
    """The comment part of a line of code, "" if there is none."""
    marker = "#" if suffix == ".py" else "//"
    at = line.find(marker)
    if at >= 0:
        return line[at:]
    return line if line.lstrip().startswith(("*", "/*")) else ""


def used_tags(root):
    uses = {}
    for path in files_below(root, CODE_FOLDERS, CODE_SUFFIXES):
        if path.is_relative_to(root / "tests" / "docs"):
            continue  # the checks speak of tags in general
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for tag in tags_in(comment_of(line, path.suffix)):
                uses.setdefault(tag, f"{path.relative_to(root)}:{number}")
    return uses


def defined_tags(root):
    """Tags at the start of headings `### (R1) …` of docs/theory, each with its place; and complaints."""
    places, complaints = {}, []
    for path in files_below(root, ["docs/theory"], {".md"}):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            heading = re.match(r"### ((?:\([PWRDQSFCH]\d+\)(?:\s*[-–,]\s*)?)+)", line)
            for tag in sorted(tags_in(heading.group(1))) if heading else ():
                place = f"{path.relative_to(root)}:{number}"
                if tag in places:
                    complaints.append(f"{place}: ({tag}) is already defined at {places[tag]}")
                places.setdefault(tag, place)
    return places, complaints


def missing_paths(root):
    """`Code:` and `Tests:` lines of docs/theory name files by path; each must be there."""
    for path in files_below(root, ["docs/theory"], {".md"}):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if re.match(r"[-*\s]*\**(Code|Tests)\b", line):
                for name in re.findall(r"[\w.-]+/[\w./-]+\.(?:hpp|cpp|py|md)\b", line):
                    if not (root / name).exists():
                        yield f"{path.relative_to(root)}:{number}: there is no file {name}"


def check_tags(root):
    defined, complaints = defined_tags(root)
    used = used_tags(root)
    complaints += [f"{used[t]}: ({t}) is defined nowhere in docs/theory" for t in sorted(used.keys() - defined.keys())]
    complaints += [f"{defined[t]}: ({t}) is used by no comment in code or tests" for t in sorted(defined.keys() - used.keys())]
    return complaints + list(missing_paths(root))


# What each part may include, by the first folder of the include. The plain reference solutions of tests/support are for what
# judges the product, tests and validation; nothing of either may be in the product.
PRODUCT = {"hydro", "dynamics", "fit", "froude", "scene", "compile"}
MAY_INCLUDE = {
    "libhydro": {"hydro"},
    "libdynamics": {"hydro", "dynamics"},
    "libfit": {"hydro", "dynamics", "fit"},
    "apps": PRODUCT,
    "python": PRODUCT,
    "validation": PRODUCT | {"harness", "support"},
    "tests": PRODUCT | {"harness", "support", "laws"},
}
# The part that an include belongs to, by its first folder.
PART = {"hydro": "libhydro", "dynamics": "libdynamics", "fit": "libfit", "froude": "apps", "scene": "apps", "compile": "apps",
        "harness": "validation", "validation": "validation", "support": "tests", "laws": "tests", "tests": "tests"}


def check_includes(root):
    complaints = []
    for path in files_below(root, MAY_INCLUDE, {".hpp", ".cpp"}):
        relative = path.relative_to(root)
        public = relative.parts[1] == "include"
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            include = re.match(r'\s*#\s*include\s*"([^"]+)"', line)
            if not include:
                continue
            name, place = include.group(1), f"{relative}:{number}"
            first = name.split("/")[0]
            if first in PART and first not in MAY_INCLUDE[relative.parts[0]]:
                complaints.append(f"{place}: {relative.parts[0]} may not include {name}")
            elif ".." in name.split("/") or "src" in name.split("/"):
                complaints.append(f"{place}: {name} reaches into private files by path")
            elif public and not (root / PART.get(first, "?") / "include" / name).exists():
                complaints.append(f"{place}: the public header includes {name}, which is not a public header")
    return complaints


def markdown_files(root):
    for path in sorted(root.rglob("*.md")):
        if not SKIPPED_FOLDERS & set(path.relative_to(root).parts):
            yield path


def check_links(root):
    complaints = []
    for path in markdown_files(root):
        fenced = False
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if line.lstrip().startswith("```"):
                fenced = not fenced
            if fenced:
                continue
            for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)):
                if re.match(r"[a-z]+:", target) or target.startswith("#"):
                    continue
                aim = (path.parent / target.split("#")[0]).resolve()
                if not aim.exists() or not aim.is_relative_to(root.resolve()):
                    complaints.append(f"{path.relative_to(root)}:{number}: the link {target} leads to no file of the repository")
    return complaints


QUOTE = re.compile(r"<!-- file: (\S+) -->\s*\n```[^\n]*\n(.*?)^```", re.DOTALL | re.MULTILINE)


def check_quotes(root):
    """A fenced block after `<!-- file: PATH -->` is that file, or whole lines of it without a gap."""
    complaints = []
    for path in markdown_files(root):
        text = path.read_text(encoding="utf-8")
        for quote in QUOTE.finditer(text):
            source = root / quote.group(1)
            place = f"{path.relative_to(root)}:{text.count(chr(10), 0, quote.start()) + 1}"
            if not source.exists():
                complaints.append(f"{place}: there is no file {quote.group(1)}")
            elif "\n" + quote.group(2) not in "\n" + source.read_text(encoding="utf-8"):
                complaints.append(f"{place}: the quote differs from {quote.group(1)}")
    return complaints


CHECKS = {"tags": check_tags, "includes": check_includes, "links": check_links, "quotes": check_quotes}


def main(arguments):
    if len(arguments) != 2 or arguments[0] not in CHECKS:
        sys.exit(__doc__)
    complaints = CHECKS[arguments[0]](Path(arguments[1]).resolve())
    print("\n".join(complaints) or f"{arguments[0]}: nothing to complain about")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
