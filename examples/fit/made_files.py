"""What the scripts beside this one share: they write the measurements that they made, or check those that are there."""
import sys


def write_or_check(files):
    """`files`: pairs of a path and its text. With --check on the command line nothing is written, and the first file that
    differs from its text ends the script with status 1 and its name."""
    for path, text in files:
        if sys.argv[1:] == ["--check"]:
            if path.read_text(encoding="utf-8") != text:
                sys.exit(f"{path} is not what this script makes")
        else:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
