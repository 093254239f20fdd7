#!/usr/bin/python3
"""Compiles every source and every public header of the product by itself.

    alone.py SOURCE_DIR SCRATCH_DIR

The build that users get compiles several files as one, which would hide an include that a file forgets. Here each file is
read alone (-fsyntax-only), by the compile commands of a build that merges nothing. A function that is declared inline and
defined nowhere, such as Eigen's inverse() without <Eigen/LU>, is an error too: it would not link. A header
that a source includes before anything else has been read alone with it; the other public ones are read as files of their own.
A file whose text, headers and command are as in the last run is not read again. Python's standard library only.

FROUDE_READ_ALONE=16 reads what the last commits touched and a sixteenth of the rest, another one after each commit: all is
twenty minutes of a core. Where git tells no history, as in an archive, all is read.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.M)
# Price lists are built by hand only: here they are read with the rest, so that they go on compiling.
READ = tuple((part,) for part in ("libhydro", "libdynamics", "libfit", "apps", "python")) + (("validation", "cost"),)
# Where public headers lie, below which part, and the folder from which they are named.
PUBLIC = (("libhydro", "include", "include"), ("libdynamics", "include", "include"), ("libfit", "include", "include"),
          ("apps", "include", "include"), ("apps", "scene", "."))


def configured(source, scratch):
    """The commands of a build without merged sources, by file; its precompiled headers are built."""
    subprocess.run(["cmake", "-S", source, "-B", scratch, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", "-DFROUDE_MERGED_SOURCES=OFF", "-DFROUDE_BUILD_TESTS=OFF",
                    "-DFROUDE_VALIDATION_CASES=OFF", "-DFROUDE_BUILD_BENCHMARKS=ON"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", scratch, "--target", "froude_library_headers", "froude_program_headers"],
                   check=True, stdout=subprocess.DEVNULL)
    return {entry["file"]: entry["command"] for entry in json.loads((scratch / "compile_commands.json").read_text())}


def alone(command, source):
    """The command that only reads `source`: without output, and with the one warning that says what would not link."""
    words, out = iter(shlex.split(command)), []
    for word in words:
        if word in ("-o", "-MF", "-MT", "-c"):
            next(words)
        elif not word.startswith("-W") and word != "-MD":
            out.append(word)
    return out + ["-Wsystem-headers", "-fsyntax-only", str(source)]


def complaints(command, source, folder):
    """What is wrong with the file when it is read alone; [] if nothing is."""
    ran = subprocess.run(alone(command, source), cwd=folder, capture_output=True, text=True)
    lines = ran.stderr.splitlines()
    if ran.returncode != 0:
        return [line for line in lines if " error: " in line] or lines[:3]
    return [line for line in lines if "used but never defined" in line]


def fingerprint(path, command, directories, seen):
    """A hash of the command, the file and all headers of this project below it."""
    seen.add(path)
    text = path.read_text()
    digest = hashlib.sha256((command + text).encode())
    for name in INCLUDE.findall(text):
        for folder in [path.parent, *directories]:
            header = (folder / name).resolve()
            if header.is_file():
                if header not in seen:
                    digest.update(fingerprint(header, "", directories, seen))
                break
    return digest.digest()


def refuses_planted_faults(command, scratch):
    """The check is itself tried: a header that is missing, and a function without its definition."""
    for name, text in (("no_header", "hydro::InputError error(\"\");\n"),
                       ("no_definition", "#include <Eigen/Core>\ndouble f(const Eigen::Matrix2d& m) "
                                         "{ return m.inverse()(0, 0); }\n")):
        file = scratch / f"{name}.cpp"
        file.write_text(text)
        if not complaints(re.sub(r"-include \S+", "", command), file, scratch):
            sys.exit(f"the check passes a planted fault: {file}")


def headers_alone(files, commands, scratch):
    """Files that hold nothing but one public header, for those that no source includes first; their commands are those
    of a source beside the header, without a precompiled one."""
    first = {match.group(1) for file in files if (match := re.search(r'^#include\s+["<]([^">]+)[">]', file.read_text(), re.M))}
    out = {}
    for part, folder, base in PUBLIC:
        neighbour = next(file for file in files if part in file.parts)
        top = next(above for above in neighbour.parents if above.name == part)
        for header in sorted((top / folder).rglob("*.hpp")):
            name = header.relative_to(top / base).as_posix()
            if name in first:
                continue
            file = scratch / "headers" / (name.replace("/", "_") + ".cpp")
            file.parent.mkdir(exist_ok=True)
            text = f'#include "{name}"\n'
            if not file.is_file() or file.read_text() != text:
                file.write_text(text)
            out[file] = re.sub(r"-include \S+", "", commands[str(neighbour)])
    return out


def git(source, *words):
    """What git prints, or nothing where there is no repository or no git."""
    try:
        ran = subprocess.run(["git", "-C", str(source), *words], capture_output=True, text=True)
    except OSError:
        return ""
    return ran.stdout.strip() if ran.returncode == 0 else ""


def of_this_commit(files, source, parts):
    """Files that commits of late or nobody has committed touched, and one of so many `parts` of the others, by lot: the
    lot is the commit's name."""
    commit = git(source, "rev-parse", "HEAD")
    if not commit:
        return files
    late = git(source, "log", "-12", "--name-only", "--format=") if git(
        source, "rev-parse", "--is-shallow-repository") == "false" else ""
    touched = {*late.splitlines(), *git(source, "diff", "--name-only", "HEAD").splitlines()}

    def drawn(file):
        return int(hashlib.sha256((commit + file.name).encode()).hexdigest(), 16) % parts == 0

    def is_touched(file):
        return source in file.parents and file.relative_to(source).as_posix() in touched

    return [file for file in files if drawn(file) or is_touched(file)]


def main():
    source, scratch = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    commands = configured(source, scratch)
    files = sorted(pathlib.Path(f) for f in commands
                   if source in pathlib.Path(f).parents and scratch not in pathlib.Path(f).parents
                   and any(pathlib.Path(f).relative_to(source).parts[:len(part)] == part for part in READ))
    refuses_planted_faults(commands[str(files[0])], scratch)
    sources, extra = len(files), headers_alone(files, commands, scratch)
    commands.update({str(file): command for file, command in extra.items()})
    files += extra
    parts = int(os.environ.get("FROUDE_READ_ALONE", "1"))
    if parts > 1:
        whole, files = len(files), of_this_commit(files, source, parts)
        print(f"{len(files)} of {whole} are read: those that commits of late touched, and one in {parts} of the others")
    directories = [source / d for d in ("libhydro/include", "libdynamics/include", "libfit/include", "apps", "apps/include")]
    record = scratch / "alone.json"
    known = json.loads(record.read_text()) if record.is_file() else {}
    prints = {file: fingerprint(file, commands[str(file)], directories, set()).hex() for file in files}
    changed = [file for file in files if known.get(str(file)) != prints[file]]
    faults = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as readers:
        for file, found in zip(changed, readers.map(lambda f: complaints(commands[str(f)], f, scratch), changed)):
            if found:
                faults += 1
                print("\n".join(found), flush=True)
            else:
                known[str(file)] = prints[file]
                record.write_text(json.dumps(known))
    print(f"of {sources} sources and {len(extra)} public headers {len(changed)} were read alone, {faults} of them cannot be")
    sys.exit(faults > 0)


main()
