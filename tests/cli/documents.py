"""Pages of docs/ as those who follow them read them: commands in order, and what they are said to print."""
import re
import shlex
from dataclasses import dataclass, field

COMMAND = "    froude "
OUTPUT = re.compile(r"<!-- output -->\s*\n```text\n(.*?)^```$", re.DOTALL | re.MULTILINE)
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
LEFT_OUT = "…"


@dataclass
class Command:
    words: list
    printed: list = field(default_factory=list)  # lines that the page shows behind it


def commands_of(text):
    """Indented lines that begin with froude, with those that a backslash continues, and the output blocks behind each."""
    text = text.replace("\\\n", " ")
    pieces = [(line.start(), Command(shlex.split(line.group(0)))) for line in re.finditer(rf"^{COMMAND}.*$", text, re.MULTILINE)]
    for block in OUTPUT.finditer(text):
        before = [command for at, command in pieces if at < block.start()]
        if not before:
            raise ValueError("an output block stands before any command")
        before[-1].printed += block.group(1).splitlines()
    return [command for _, command in pieces]


def last_digit(number):
    """What one unit of the last digit of a printed number is worth."""
    digits, _, power = number.lower().partition("e")
    return 10.0 ** (int(power or 0) - len(digits.partition(".")[2]))


def same_line(shown, printed):
    """Whether a printed line is the one shown: the same words, and numbers that differ by at most one in the last digit shown,
    which is how far rounding on another processor may carry them. A line that ends in … may go on otherwise."""
    goes_on = shown.rstrip().endswith(LEFT_OUT)
    shown = shown.rstrip().removesuffix(LEFT_OUT).rstrip() if goes_on else shown
    words = NUMBER.sub("#", shown).split()
    told = NUMBER.sub("#", printed).split()
    if (told[:len(words)] if goes_on else told) != words:
        return False
    numbers = NUMBER.findall(shown)
    return all(abs(float(a) - float(b)) <= 1.001 * last_digit(a) for a, b in zip(numbers, NUMBER.findall(printed)))


def missing_line(shown, printed):
    """The first shown line that does not stand where it should among the printed ones, or none. Lines that are shown one after
    the other were printed so; a line with nothing but … stands for any number of lines."""
    at, free = 0, True
    for line in shown:
        if line.strip() == LEFT_OUT:
            free = True
            continue
        places = range(at, len(printed)) if free else range(at, min(at + 1, len(printed)))
        found = next((i for i in places if same_line(line, printed[i])), None)
        if found is None:
            return line
        at, free = found + 1, False
    return None
