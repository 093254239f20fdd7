#!/usr/bin/python3
"""Each name that scripts/test leaves out of the sanitized run names a test: one that was renamed would come back in silence.

    left_out_test.py SOURCE_DIR
"""
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
TEST = re.compile(r"^(?:TEST|TEST_F|TEST_P|TYPED_TEST)\((\w+),\s*(\w+)\)", re.MULTILINE)


class LeftOut(unittest.TestCase):
    def test_names_are_those_of_tests(self):
        tests = [".".join(found) for file in (SOURCE / "tests").rglob("*.cpp") for found in TEST.findall(file.read_text())]
        left_out = re.search(r'^long="(.*?)"$', (SOURCE / "scripts/test").read_text(), re.MULTILINE | re.DOTALL).group(1).split()
        self.assertEqual([name for name in left_out if not any(name in test for test in tests)], [])


if __name__ == "__main__":
    unittest.main()
