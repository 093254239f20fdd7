"""How Sphinx makes the site of what scripts/site has laid out. Equations of docs/theory are text with Unicode; typeset()
gives them the letters, indices and exponents of print, without any script in the browser."""
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

TOKEN = re.compile(r"(?P<raise>[\^_])(?:\{(?P<braced>[^{}]*)\}|(?P<single>(?<=_)[A-Za-z0-9]{2,3}(?![A-Za-z0-9])|"
                   r"[−-]?[A-Za-z0-9α-ωΑ-Ω]|[∞*+−-]))|(?P<word>[A-Za-z]{2,})|(?P<letter>[A-Za-zα-ωϑϕ])|(?P<other>.)", re.DOTALL)
# In running text: an index or an exponent behind a letter by itself or a bracket, in braces or of one to three letters or digits.
IN_TEXT = re.compile(r"(?:(?<=(?<![A-Za-z0-9/.-])[A-Za-zα-ωΑ-Ω])|(?<=[)\]}∫Σ∏∞₀-₉̂̄]))([_^])"
                     r"(?:\{([^{}]*)\}|([−-]?\w{1,3}|[∞*+])(?!\w))")


def typeset(text):
    """HTML of an equation: single letters in italics, words and functions upright, ^ and _ as they are in print."""
    out = []
    for token in TOKEN.finditer(text):
        if token["raise"]:
            tag = "sup" if token["raise"] == "^" else "sub"
            inside = token["braced"] if token["braced"] is not None else token["single"]
            out.append(f"<{tag}>" + (f"<i>{inside}</i>" if re.fullmatch("[a-z]{2}", inside) else typeset(inside)) + f"</{tag}>")
        elif token["letter"]:
            out.append(f"<i>{token['letter']}</i>")
        else:
            out.append(html.escape(token.group(0)))
    return "".join(out)


def pieces(text):
    """Text and raised or lowered pieces of a paragraph, as nodes."""
    at = 0
    for found in IN_TEXT.finditer(text):
        yield nodes.Text(text[at:found.start()])
        inner = found[2] if found[2] is not None else found[3]
        node = nodes.superscript if found[1] == "^" else nodes.subscript
        yield node("", inner)
        at = found.end()
    yield nodes.Text(text[at:])


AS_IT_IS = (nodes.literal, nodes.literal_block, nodes.raw, nodes.title, nodes.comment)


class Equations(SphinxPostTransform):
    default_priority = 5

    def run(self):
        if not self.env.docname.startswith("docs/theory/"):
            return
        for block in list(self.document.findall(nodes.literal_block)):
            if block.get("language", "default") in ("default", "none"):
                set_ = f'<pre class="equation">{typeset(block.astext())}</pre>'
                block.replace_self(nodes.raw("", set_, format="html"))
        for text in list(self.document.findall(nodes.Text)):
            inside = text.parent
            if not isinstance(inside, AS_IT_IS) and IN_TEXT.search(text):
                inside.replace(text, list(pieces(text.astext())))


def setup(app):
    app.add_post_transform(Equations)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
