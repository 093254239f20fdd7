#!/usr/bin/python3
"""The site that scripts/site makes: every link and picture is there, nothing is asked of a network, and equations are set.

    site_test.py ROOT

Exit status 77 (skipped) where the packages of `scripts/setup site` are missing.
"""
import html.parser
import re
import runpy
import subprocess
import sys
import tempfile
import unittest
import urllib.parse
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
# What a browser fetches by itself; a link that waits for a click may lead outside.
FETCHED = {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("video", "src"),
           ("object", "data")}
NO_FETCH = {"canonical", "author", "help", "index", "search", "next", "prev", "copyright", "alternate"}  # of <link rel>


class Page(html.parser.HTMLParser):
    """Links, names that links can lead to, and what is fetched, each with its line."""

    def __init__(self, text):
        super().__init__()
        self.links, self.names, self.fetched = [], set(), []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.names |= {given[key] for key in ("id", "name") if given.get(key)}
        for key in ("href", "src", "data"):
            value = given.get(key)
            if value is None or (tag, key) == ("object", "data") and value.startswith("data:"):
                continue
            if (tag, key) in FETCHED and not (tag == "link" and set((given.get("rel") or "").split()) & NO_FETCH):
                self.fetched.append((value, self.getpos()[0]))
            if (tag, key) in FETCHED or (tag, key) == ("a", "href"):
                self.links.append((value, self.getpos()[0]))


def complaints_of(site):
    """One line on each link that leads nowhere and each request to a network."""
    pages = {path: Page(path.read_text(encoding="utf-8", errors="replace")) for path in sorted(site.rglob("*.html"))}
    for path, page in pages.items():
        where = path.relative_to(site)
        for target, line in page.fetched:
            if re.match(r"(https?:)?//", target):
                yield f"{where}:{line}: fetches {target}"
        for target, line in page.links:
            if re.match(r"[a-z]+:|//", target):
                continue
            name, _, anchor = target.partition("#")
            aim = (path.parent / urllib.parse.unquote(name.split("?")[0])).resolve() if name else path
            if not aim.is_file():
                yield f"{where}:{line}: {target} leads to no file"
            elif anchor and aim in pages and urllib.parse.unquote(anchor) not in pages[aim].names:
                yield f"{where}:{line}: {target} leads to no place on that page"
    for path in sorted(site.rglob("*.css")):
        for target in re.findall(r"url\(\s*['\"]?([^)'\"\s]+)", path.read_text(encoding="utf-8", errors="replace")):
            if re.match(r"(https?:)?//", target):
                yield f"{path.relative_to(site)}: fetches {target}"


class Checker(unittest.TestCase):
    def complaints(self, body):
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "a.html").write_text(f"<html><body id='top'>{body}</body></html>", encoding="utf-8")
            Path(folder, "b.png").write_bytes(b"")
            return list(complaints_of(Path(folder)))

    def test_takes_what_is_there(self):
        self.assertEqual(self.complaints("<a href='#top'>a</a><img src='b.png'><a href='https://example.org'>x</a>"), [])

    def test_refuses_what_is_not(self):
        for body, said in (("<a href='c.html'>c</a>", "leads to no file"), ("<img src='c.png'>", "leads to no file"),
                           ("<a href='a.html#x'>x</a>", "leads to no place"),
                           ("<script src='https://example.org/x.js'></script>", "fetches")):
            with self.subTest(body=body):
                found = self.complaints(body)
                self.assertEqual(len(found), 1, found)
                self.assertIn(said, found[0])


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="froude_site_")
        cls.site = Path(cls.folder.name, "site")
        cls.done = subprocess.run([sys.executable, "-B", str(ROOT / "scripts" / "site"), "-o", str(cls.site)],
                                  capture_output=True, text=True, check=False)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_is_made_without_a_warning(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertEqual(self.done.stderr, "")

    def test_has_no_link_that_leads_nowhere_and_asks_no_network(self):
        found = list(complaints_of(self.site))
        self.assertEqual(found, [], "\n".join(found[:40]))

    def test_has_each_page_of_the_documents_and_both_references(self):
        for page in sorted((ROOT / "docs").rglob("*.md")):
            self.assertTrue((self.site / page.relative_to(ROOT).with_suffix(".html")).is_file(), page)
        self.assertIn("froude.read", (self.site / "docs" / "python-api.html").read_text(encoding="utf-8"))
        self.assertIn("Coefficients", (self.site / "cpp" / "annotated.html").read_text(encoding="utf-8"))

    def test_can_be_searched(self):
        index = (self.site / "searchindex.js").read_text(encoding="utf-8")
        for word in ("heav", "docs/theory/radiation"):
            self.assertIn(word, index)

    def test_sets_equations(self):
        page = (self.site / "docs" / "theory" / "conventions.html").read_text(encoding="utf-8")
        self.assertIn('<pre class="equation">', page)
        self.assertIn("<i>A</i> = <i>ρ</i> <i>L</i><sup>3+<i>r</i></sup>", page)
        self.assertNotRegex(re.sub(r"<pre.*?</pre>|<code.*?</code>", "", page, flags=re.DOTALL), r"<p>[^<]*e\^\{")


if __name__ == "__main__":
    lacks = " ".join(runpy.run_path(str(ROOT / "scripts" / "site"))["missing"]())
    if lacks:
        print(f"skipped, without {lacks}: scripts/setup site installs them")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
