#!/usr/bin/python3
"""What is compiled for AVX2 leaves no function that the rest of the program could take for its own: on a processor without
AVX2 that would be an illegal instruction, far from here.

    wide_test.py OBJECT
"""
import subprocess
import sys
import unittest

OBJECT = sys.argv.pop(1)


class Wide(unittest.TestCase):
    def test_all_that_others_may_take_has_the_other_name(self):
        listed = subprocess.run(["nm", "--demangle", "--defined-only", OBJECT], check=True, capture_output=True, text=True).stdout
        offered = [line[17:] for line in listed.splitlines() if line[17] in "TWVuDBR"]
        ours = ["hydro::detail::wide_transposed_product", "hydro::detail::wide_add_product"]
        for name in ours:
            self.assertTrue(any(name in other for other in offered), listed)
        foreign = [name for name in offered
                   if "FroudeWideEigen::" not in name and not any(own in name for own in ours)
                   and "DW.ref.__gxx_personality_v0" not in name]  # a pointer, no function
        self.assertEqual(foreign, [])


if __name__ == "__main__":
    unittest.main()
