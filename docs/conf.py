"""Settings of Sphinx for the site; `python tools/build_site.py FOLDER` builds it."""

from pygments.lexers.data import JsonLexer
from sphinx.application import Sphinx

from urdfsync import __version__

project = "urdfsync"
author = "the urdfsync authors"
release = __version__
copyright = author  # noqa: A001 - Sphinx's name

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 4  # by the names that GitHub gives to headings
default_role = "code"
autodoc_preserve_defaults = True
maximum_signature_line_length = 80

smartquotes = False  # options stay as they are typed

html_theme = "furo"
html_title = "urdfsync"
html_show_copyright = False
html_show_sphinx = False


def setup(app: Sphinx) -> None:
    """Colour the lines of the daemon as JSON."""
    app.add_lexer("jsonl", JsonLexer)
