"""How Sphinx makes the site of what scripts/site has laid out. Equations of docs/theory are text with Unicode; typeset() gives them the
letters, indices and exponents of print, without any script in the browser."""
import html
import re

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

project = "Froude"
extensions = ["myst_parser"]
root_doc = "docs/site/index"
html_theme = "furo"
html_title = "Froude"
html_show_sphinx = False
html_show_copyright = False
html_show_sourcelink = False
html_copy_source = False
html_static_path = ["static"]
html_css_files = ["froude.css"]
myst_heading_anchors = 4
highlight_language = "none"
suppress_warnings = ["myst.header"]

UPRIGHT = ("Re|Im|sin|cos|tan|sinh|cosh|tanh|coth|exp|ln|log|max|min|sup|inf|diag|conj|sqrt|arg|det|tr|sign|rms|atan|atan2|acos|asin|erf|mod|"
           "var|cov|span|rank|dim")
TOKEN = re.compile(rf"(?P<raise>\^|_)(?:\{{(?P<braced>[^{{}}]*)\}}|(?P<single>[A-Za-z0-9α-ωΑ-Ω∞*+−-]))|(?P<word>(?:{UPRIGHT})\b|[A-Za-z]{{2,}})|"
                   r"(?P<letter>[A-Za-zα-ωϑϕ])|(?P<other>.)", re.DOTALL)
# In running text: a letter with an index or an exponent, in braces or of one to three letters or digits.
IN_TEXT = re.compile(r"(?<![\w/.-])([A-Za-zα-ωΑ-Ω]̄?|[)\]])([_^])(?:\{([^{}]*)\}|(\w{1,3})(?!\w))")


def typeset(text):
    """HTML of an equation: single letters in italics, words and functions upright, ^ and _ as they are in print."""
    out = []
    for token in TOKEN.finditer(text):
        if token["raise"]:
            tag = "sup" if token["raise"] == "^" else "sub"
            out.append(f"<{tag}>{typeset(token['braced'] if token['braced'] is not None else token['single'])}</{tag}>")
        elif token["letter"]:
            out.append(f"<i>{token['letter']}</i>")
        else:
            out.append(html.escape(token.group(0)))
    return "".join(out)


def pieces(text):
    """Text and raised or lowered pieces of a paragraph, as nodes."""
    at = 0
    for found in IN_TEXT.finditer(text):
        yield nodes.Text(text[at:found.end(1)])
        inner = found[3] if found[3] is not None else found[4]
        node = nodes.superscript if found[2] == "^" else nodes.subscript
        yield node("", inner)
        at = found.end()
    yield nodes.Text(text[at:])


class Equations(SphinxPostTransform):
    default_priority = 5

    def run(self):
        if not self.env.docname.startswith("docs/theory/"):
            return
        for block in list(self.document.findall(nodes.literal_block)):
            if block.get("language", "default") in ("default", "none"):
                block.replace_self(nodes.raw("", f'<pre class="equation">{typeset(block.astext())}</pre>', format="html"))
        for text in list(self.document.findall(nodes.Text)):
            inside = text.parent
            if not isinstance(inside, (nodes.literal, nodes.literal_block, nodes.raw, nodes.title, nodes.comment)) and IN_TEXT.search(text):
                inside.replace(text, list(pieces(text.astext())))


def setup(app):
    app.add_post_transform(Equations)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
