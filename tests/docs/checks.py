#!/usr/bin/python3
"""Checks that the documents and the code still agree.

    checks.py tags|includes|links|quotes|words|extending|examples ROOT

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
TAG = re.compile(r"(?<![\w)\]])\(([PWRDQSFCHV])(\d+)\)")
TAG_RANGE = re.compile(r"(?<![\w)\]])\(([PWRDQSFCHV])(\d+)\)\s*[-–]\s*\(([PWRDQSFCHV])(\d+)\)")


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
            heading = re.match(r"### ((?:\([PWRDQSFCHV]\d+\)(?:\s*[-–,]\s*)?)+)", line)
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


# What each part may use. The plain reference solutions of tests/support are for what judges the product, tests and
# validation; nothing of either may be in the product.
PRODUCT = {"libhydro", "libdynamics", "libfit", "apps"}
MAY_USE = {
    "libhydro": {"libhydro"},
    "libdynamics": {"libhydro", "libdynamics"},
    "libfit": {"libhydro", "libdynamics", "libfit"},
    "apps": PRODUCT,
    "python": PRODUCT | {"python"},
    "validation": PRODUCT | {"validation", "tests"},
    "tests": PRODUCT | {"validation", "tests"},
}
# What judges the product may use of each other's parts these folders alone.
MAY_USE_OF = {("validation", "tests"): {"support"}, ("tests", "validation"): {"harness"}}
# The floors of each part, lowest first: a folder uses itself and those before it. "*" are all other folders, none of which
# uses another; files that are in no folder may use all. docs/design.md draws the same.
# Rooms inside a folder have floors too, where it is listed; "." is what stands in the folder itself.
FLOORS = {
    "libhydro": ("base", "io", "signal", "waves", "radiation", "hydrostatics", "potential", "cylinders", "panels"),
    "libdynamics": ("algebra", "spatial", "time", "line", "state", "control", "joint", "force", "model", "integrate", "frequency"),
    "apps": ("scene", "include", "compile", "answers", "sweep", "view", "report", "interchange", "froude"),
    "validation": ("harness", "*"),
    "tests": ("support", "laws", "*"),
    "libhydro/waves": (".", "spectra", "kinematics", "synthesis"),
    "libhydro/potential": (".", "operations", "formats", "doctor"),
    "apps/froude": (".", "*"),
}
# The part that an include belongs to, by its first folder.
PART = {"hydro": "libhydro", "dynamics": "libdynamics", "fit": "libfit", "froude": "apps", "scene": "apps", "compile": "apps",
        "answers": "apps", "sweep": "apps", "view": "apps", "report": "apps", "interchange": "apps",
        "harness": "validation", "validation": "validation", "support": "tests", "laws": "tests", "tests": "tests"}


def folder_of(path):
    """The part and its folder that a path of the repository lies in; what is public and what is private count as one."""
    part, *rest = path.parts
    if part.startswith("lib"):
        rest = rest[{"include": 2, "src": 1}.get(rest[0], 0):]
    return part, rest[0] if len(rest) > 1 else ""


def room_of(path):
    """The folder of a part that a path lies in, and the room of that folder, "." where it lies in none; "" without a folder."""
    part, folder = folder_of(path)
    within = path.parts[path.parts.index(folder, 1) + 1:] if folder else ()
    return f"{part}/{folder}", (within[0] if len(within) > 1 else ".") if folder else ""


def included(root, path, name):
    """The file that an include of `path` leads to, as a path of the repository; none if it is another project's."""
    part = path.parts[0]
    for folder in (path.parent, "libhydro/include", "libdynamics/include", "libfit/include", "apps/include", "apps", "validation", "tests", f"{part}/src"):
        if (root / folder / name).exists():
            return (root / folder / name).resolve().relative_to(root)
    first, *rest = name.split("/")
    if first not in PART:
        return None
    part = PART[first]
    return Path(part, "include", name) if part.startswith("lib") else Path(part, *rest) if first == part else Path(part, name)


def shortest_circle(edges):
    """The nodes of the shortest way along edges, pairs (from, to), that ends where it began; the last is the first again."""
    onward, best = {}, []
    for begin, end in sorted(edges):
        onward.setdefault(begin, []).append(end)
    for begin in sorted(onward):
        came_from, queue = {}, [begin]
        for node in queue:
            for end in onward.get(node, ()):
                if end not in came_from:
                    came_from[end] = node
                    queue.append(end)
        if begin in came_from:
            way = [begin, came_from[begin]]
            while way[-1] != begin:
                way.append(came_from[way[-1]])
            if not best or len(way) < len(best):
                best = way[::-1]
    return best


def circle_complaint(edges):
    """One line on the shortest circle of edges {(from, to): place}, if there is one."""
    way = shortest_circle(edges)
    steps = [f"{a} → {b} at {edges[a, b]}" for a, b in zip(way, way[1:])]
    return ["a circle: " + ", ".join(steps)] if steps else []


def floor_complaint(part, folder, used):
    """Why a folder may not use another of the same part; none if it may."""
    floors = FLOORS.get(part)
    if folder in ("", used) or floors is None:
        return None
    for name in (folder, used):
        if name not in floors and "*" not in floors:
            return f"{part}/{name} has no floor in tests/docs/checks.py"
    level = [floors.index(name if name in floors else "*") if name else len(floors) for name in (folder, used)]
    if level[0] > level[1]:
        return None
    return f"{part}/{folder} may not include {part}/{used}, which is " + ("above it" if level[0] < level[1] else "beside it")


# Headers of the grammar that are installed, for elements of a user's own.
PUBLIC_GRAMMAR = {Path("apps/scene", name) for name in ("binding.hpp", "document.hpp", "element.hpp", "record.hpp", "scene.hpp", "schema.hpp",
                                                      "waves.hpp")}


def is_public(path):
    return path.parts[1] == "include" or path in PUBLIC_GRAMMAR


def include_complaint(root, path, name):
    """Why `path` may not include `name`; none if it may."""
    part, folder = folder_of(path)
    aim = included(root, path, name)
    if ".." in name.split("/") or "src" in name.split("/"):
        return f"{name} reaches into private files by path"
    if aim is None:
        return f"the public header includes {name}, which is not a public header" if is_public(path) else None
    used_part, used = folder_of(aim)
    if used_part not in MAY_USE[part] or used not in MAY_USE_OF.get((part, used_part), {used}):
        return f"{part} may not include {name}"
    if is_public(path) and not (is_public(aim) and (root / aim).exists()):
        return f"the public header includes {name}, which is not a public header"
    if used_part != part:
        return None
    (home, room), (other, used_room) = room_of(path), room_of(aim)
    return floor_complaint(part, folder, used) or (floor_complaint(home, room, used_room) if home == other else None)


def own_includes(root):
    """Every include of a file of this repository that names one of its files, as (path, line number, name)."""
    for path in files_below(root, MAY_USE, {".hpp", ".cpp"}):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            include = re.match(r'\s*#\s*include\s*(["<])([^">]+)[">]', line)
            if include and (include.group(1) == '"' or include.group(2).split("/")[0] in PART):
                yield path.relative_to(root), number, include.group(2)


def check_folders(root):
    complaints, edges = [], {}
    for path, number, name in own_includes(root):
        place = f"{path}:{number}"
        complaint = include_complaint(root, path, name)
        if complaint:
            complaints.append(f"{place}: {complaint}")
        aim = included(root, path, name)
        if aim is not None and folder_of(aim) != folder_of(path):
            edges.setdefault(("/".join(folder_of(path)), "/".join(folder_of(aim))), place)
    return complaints + circle_complaint(edges)


# Commands that make a target, and its name by their first argument.
MAKES_TARGET = {"add_library": "{}", "add_executable": "{}", "pybind11_add_module": "{}", "froude_library": "froude_{}",
                "froude_test": "test_{}"}


def targets(root):
    """The targets that CMake builds, {name: part}, and what they link, {(from, to): place}."""
    parts, links = {}, {}
    for path in sorted(root.rglob("CMakeLists.txt")):
        relative = path.relative_to(root)
        if SKIPPED_FOLDERS & set(relative.parts) or relative.parts[0] not in MAY_USE:
            continue
        text = re.sub(r"#[^\n]*", "", path.read_text(encoding="utf-8"))
        for call in re.finditer(r"\b(\w+)\s*\(([^()]*)\)", text):
            command, words = call.group(1), re.findall(r"[\w-]+(?:::[\w-]+)*", call.group(2).replace("froude::", "froude_"))
            if command not in MAKES_TARGET and command != "target_link_libraries" or "ALIAS" in words:
                continue
            name = MAKES_TARGET.get(command, "{}").format(words[0])
            if command in MAKES_TARGET:
                parts[name] = relative.parts[0]
            linked = words[words.index("LIBRARIES"):] if "LIBRARIES" in words else words if command not in MAKES_TARGET else []
            for word in linked:
                links.setdefault((name, word), f"{relative}:{text.count(chr(10), 0, call.start()) + 1}")
    return parts, {link: place for link, place in links.items() if set(link) <= parts.keys() and link[0] != link[1]}


def check_targets(root):
    parts, links = targets(root)
    return [f"{place}: {parts[a]} may not link {b} of {parts[b]}" for (a, b), place in sorted(links.items())
            if parts[b] not in MAY_USE[parts[a]]] + circle_complaint(links)


def check_drawing(root):
    """docs/design.md draws the floors as they are listed here."""
    page = root / "docs" / "design.md"
    lines = [line.split() for line in page.read_text(encoding="utf-8").splitlines()] if page.exists() else None
    return [f"docs/design.md: the floors of {part} are not drawn as {' < '.join(floors)}" for part, floors in FLOORS.items()
            if lines is not None and [part, *" < ".join(floors).split()] not in lines]


def check_includes(root):
    return check_folders(root) + check_targets(root) + check_drawing(root)


def markdown_files(root):
    for path in sorted(root.rglob("*.md")):
        if not SKIPPED_FOLDERS & set(path.relative_to(root).parts):
            yield path


NAMED_TEST = re.compile(r"\[`(\w+)\.(\w+)`\]\(([^)\s]+\.cpp)\)")
TEST = re.compile(r"^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\)", re.MULTILINE)


def named_tests(root):
    """A link `[`Suite.Name`](FILE.cpp)` leads to a file that has this test; docs/stability.md names all of tests/stability."""
    told = set()
    for path in markdown_files(root):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for suite, name, target in NAMED_TEST.findall(line):
                file = (path.parent / target).resolve()
                told.add((file, suite, name))
                if file.exists() and (suite, name) not in TEST.findall(file.read_text(encoding="utf-8")):
                    yield f"{path.relative_to(root)}:{number}: {target} has no test {suite}.{name}"
    if not (root / "docs" / "stability.md").exists():
        return
    for file in sorted((root / "tests" / "stability").glob("*.cpp")):
        for suite, name in TEST.findall(file.read_text(encoding="utf-8")):
            if (file.resolve(), suite, name) not in told:
                yield f"docs/stability.md:1: {file.relative_to(root)} has the test {suite}.{name}, which no row names"


def check_links(root):
    complaints = list(named_tests(root))
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


# Private words and the glossary's terms for them. Many have other senses elsewhere (waves travel, matrices have a condition number), so
# each is refused by its pattern in its folders only, on single lines.
MECHANICS = ("libdynamics", "apps", "tests/dynamics", "tests/laws", "tests/stability", "tests/apps", "validation", "docs/guide",
             "docs/theory/dynamics.md", "docs/theory/loads.md", "docs/theory/lines.md")
LAWS = ("libdynamics", "tests/dynamics", "tests/laws")
EVERYWHERE = ("libhydro", "libdynamics", "libfit", "apps", "python", "tests", "validation", "docs", "examples", "README.md")
STRANGERS = [(re.compile(pattern), term, folders) for pattern, term, folders in (
    (r"\b(?:Joint)?Lead\b|\bLeadCondition\b|\blead_(?:rates|table|of)\b|\bled_(?:harmonically|through|by)\b|\.lead\b|\bare_led\b|"
     r"\b(?:joint|line)\.lead\b|`lead`|(?:\b|\\n)lead = \{ ?\w|\b(?:[Jj]oint|[Hh]inge|[Ss]lider|[Nn]ode|[Ee]nd)s?(?: that (?:is|are))? led\b|"
     r"\bled (?:joint|hinge|slider|node|end)s?\b|\blead(?:s|ing)? (?:a |the )?(?:joint|hinge|slider)s?\b",
     "prescribed motion", EVERYWHERE),
    (r"\b(?:Point|Axes|Gap|Stick)?Conditions?(?:Ends|Law)?\b|(?<![a-z])conditions?(?![a-z])(?! number| of some| below)", "constraint",
     (*LAWS, "docs/theory/dynamics.md")),
    (r"\bconditions? of (?:a |the )?joints?\b", "constraint", EVERYWHERE),
    (r"\b(?:Joint)?Travel(?:Law|Motion|Force)?\b|(?:\b|_)travels?\b", "joint coordinate", MECHANICS),
    (r"pulls_only|\bpull(?:s|ing)?[- ]only\b", "tension-only", EVERYWHERE),
    (r"keeps?_lengths?|\bkeeps? (?:its|their) lengths?\b", "inextensible", EVERYWHERE),
    (r"(?:\b|\\n)sags\b(?= =|[`\";)]| \|\|)|\.sags\b|\bsegments? that sags?\b", "catenary segment", EVERYWHERE),
    (r"(?:->|\.|::)strain\(|\bis strained\b", "utilisation", LAWS),
    (r"\bsteepness\b", "slope", LAWS),
    (r"\bAnswer\b", "spring–damper force", LAWS),
    (r"\bMeeting\b|\bmeeting\(|\bmeet\((?=const Shape|Box|Rod|Ball)", "closest points", LAWS),
    (r"\bContinuedDamping\b|\bcontinued\(|\bdamping (?:is )?continued\b", "extrapolated damping", EVERYWHERE),
    (r"\bdecided\(|\bpast has decided\b", "history force", EVERYWHERE),
    (r"\b[Oo]penness\b", "interpolation error", EVERYWHERE),
    (r"\b[Rr]emember(?:s|ed|ing)?\b", "radiation memory", EVERYWHERE),
    (r"\b(?:potential::)?carried\((?!\))|\bcarried along the water\b|--carry\b", "translated coefficients", EVERYWHERE),
    (r"\bas lossy as\b", "equivalent linearisation", EVERYWHERE),
    (r"\b(?:does|did) not add up\b", "energy residual", EVERYWHERE),
    (r"to_waves_that_return|\byields to waves\b", "active absorption", EVERYWHERE),
    (r"\bfroude section\b|\bSectionArguments\b|(?<!poincare_)\bsection_(?:at|every)\(", "Poincaré section", EVERYWHERE),
    (r"\bkinship\b|correlation_of_blocks", "block correlation", EVERYWHERE),
    (r"\b[Cc]ompanion\b(?! matrix)", "perturbed trajectory", ("libdynamics", "apps", "tests/dynamics/line", "docs")),
    (r"\bheavy_bodies\b|\b(?:p|prepared|out)\.heavy\b", "bodies with gravity", EVERYWHERE),
    (r"\b(?:friction|contacts?) changes? (?:\{\}|\d+) times\b", "stick–slip events", EVERYWHERE),
    (r"\bdoctor warns\b", "warning", EVERYWHERE),
    (r"\b(?:cylinders->|out\.)sorts\b|\bsorts? of constraint", "types", EVERYWHERE),
    (r"\bha(?:s|ve) no part in a\b", "does not apply to", EVERYWHERE),
)]
# What docs/guide/extending.md tells of each extension point, in this order.
EXTENSION_POINTS = ("A force element", "A joint property", "A line property", "A spectrum", "A coefficient reader", "A fit model")
STEPS = ("Interface", "Files", "Listed in", "Links", "Tests", "Entry")
LINK = re.compile(r"\[(`?)([^\]`]+)`?\]\(([^)\s]+)\)")


def named_in(path, number, line, root):
    """Complaints on links of a line: each leads to a file, and a name in code type stands in it, as a whole word."""
    for quoted, name, target in LINK.findall(line):
        aim = (path.parent / target).resolve()
        if not aim.exists():
            yield f"{path.relative_to(root)}:{number}: {target} is not there"
        elif quoted and not re.search(rf"(?<!\w){re.escape(name)}(?!\w)", aim.read_text(encoding="utf-8")):
            yield f"{path.relative_to(root)}:{number}: {target} has no {name}"


def check_extending(root):
    """docs/guide/extending.md: every point with its steps, their files and names, and as many files as it says."""
    path, complaints, found = root / "docs" / "guide" / "extending.md", [], {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        complaints += named_in(path, number, line, root)
        if line.startswith("## "):
            found[line[3:]] = []
        step = re.match(r"\| ([A-Z][a-z ]+?)(?: \((\d+)\))? \| (.*)", line)
        if not step or not found:
            continue
        list(found.values())[-1].append(step.group(1))
        own = [name for quoted, name, _ in LINK.findall(step.group(3)) if not quoted and name.startswith(("the ", "its ", "keys "))]
        if step.group(2) and int(step.group(2)) != len(own):
            complaints.append(f"{path.relative_to(root)}:{number}: {len(own)} files are named where {step.group(2)} are told of")
    for point in EXTENSION_POINTS:
        if tuple(found.get(point, ())) != STEPS:
            complaints.append(f"{path.relative_to(root)}:1: \"{point}\" does not have the steps {', '.join(STEPS)}")
    return complaints


# Scripts that make data of other examples, and what they share, are no examples themselves; nor is what `froude calibrate` writes.
NO_EXAMPLE = re.compile(r"(make_\w+|made_files)\.py|lens\.toml")
INDEX = Path("docs", "examples.md")


def examples_in_help(root):
    """Examples that the help of the programs names, but for what a command there writes, with their places."""
    for path in files_below(root, ["apps"], {".cpp"}):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for name in re.findall(r"(?<!-o )\bexamples/[\w/]+\.toml", line):
                yield path, number, name


def check_examples(root):
    """docs/examples.md has each example: a scene or a study under a heading with its command, time and picture, a program in a row."""
    text = (root / INDEX).read_text(encoding="utf-8")
    linked = {(root / "docs" / target).resolve() for target in re.findall(r"\]\((\.\./examples/[^)\s]+)\)", text)}
    complaints = [f"{INDEX}:1: {path.relative_to(root)} is missing" for path in files_below(root, ["examples"], {".toml", ".py", ".cpp"})
                  if not NO_EXAMPLE.fullmatch(path.name) and path.resolve() not in linked]
    for heading in re.finditer(r"^### \[([^\]]+)\]\(\.\./examples/([^)\s]+)\)\n(.*?)(?=^##|\Z)", text, re.DOTALL | re.MULTILINE):
        name, target, section = heading.groups()
        place = f"{INDEX}:{text.count(chr(10), 0, heading.start()) + 1}"
        if name != target:
            complaints.append(f"{place}: {name} leads to {target}")
        wanted = {"a command that names it": rf"^    froude .*examples/{re.escape(target)}\b", "its time": r"^Takes .*\d (s|min)\.$",
                  "a picture": r"^!\[[^\]]+\]\(pictures/examples/"}
        complaints += [f"{place}: {name} has not {what}" for what, pattern in wanted.items() if not re.search(pattern, section, re.MULTILINE)]
    complaints += [f"{path.relative_to(root)}:{number}: {name} is no example" for path, number, name in examples_in_help(root)
                   if not (root / name).exists()]
    return complaints


WORDED_SUFFIXES = {".hpp", ".cpp", ".py", ".md", ".toml"}


def worded_files(root):
    """Where words are looked at: not in data of others, nor in the checks, which name the strangers."""
    for path in (root / "README.md", *files_below(root, [f for f in EVERYWHERE if f != "README.md"], WORDED_SUFFIXES)):
        relative = path.relative_to(root)
        if path.exists() and relative.parts[:2] != ("tests", "docs") and "reference" not in relative.parts:
            yield path, relative


def check_words(root):
    """No private word stands where the field has a term; and the glossary has each of these terms."""
    complaints = []
    for path, relative in worded_files(root):
        of_file = [s for s in STRANGERS if any(relative.is_relative_to(folder) for folder in s[2])]
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            for pattern, term, _ in of_file:
                found = pattern.search(line)
                if found:
                    complaints.append(f"{relative}:{number}: \"{found.group().strip()}\" is no word of the field; the glossary has \"{term}\"")
    glossary = root / "docs" / "glossary.md"
    if glossary.exists():
        told = glossary.read_text(encoding="utf-8")
        complaints += [f"docs/glossary.md:1: the term \"{term}\" is missing" for _, term, _ in STRANGERS if f"| **{term}** |" not in told]
    return complaints


CHECKS = {"tags": check_tags, "includes": check_includes, "links": check_links, "quotes": check_quotes, "words": check_words,
          "extending": check_extending, "examples": check_examples}


def main(arguments):
    if len(arguments) != 2 or arguments[0] not in CHECKS:
        sys.exit(__doc__)
    complaints = CHECKS[arguments[0]](Path(arguments[1]).resolve())
    print("\n".join(complaints) or f"{arguments[0]}: nothing to complain about")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
