"""The site of the documentation: python -m sphinx -W -n docs build/site

Its pages are Markdown that reads as well in the repository; `docs/generate.py` writes those that
come from the program.
"""

from __future__ import annotations

import sys
from pathlib import Path

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx

DOCS = Path(__file__).resolve().parent
sys.path.insert(0, str(DOCS.parent))

from adamslite import __version__  # noqa: E402  (a checkout need not be installed)

project = "adamslite"
author = copyright = "the adamslite authors"
release = version = __version__

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
smartquotes = False  # -- is the beginning of a flag
default_role = "code"
myst_heading_anchors = 4
highlight_language = "none"
# Notebooks have no outputs in the repository: the site runs them.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_execution_in_temp = True

# Members of classes, but not what they have from classes of Python.
autodoc_default_options = {
    "members": True,
    "inherited-members": "BaseException, Enum, list, tuple",
}
autodoc_typehints = "none"  # the docstrings have types, with shapes
autodoc_preserve_defaults = True
napoleon_google_docstring = False
# Types in docstrings are words ("(nt,) array", "iterable of str"), not names to be looked up.
nitpick_ignore_regex = [("py:.*", ".*")]

html_theme = "furo"
html_title = "adamslite"
html_show_sphinx = False
html_copy_source = False
html_show_sourcelink = False


def keep_text_of_links_out(app: Sphinx, page: nodes.document) -> None:
    """Links to folders and pages of the repository outside of docs/ become their text.

    Single files there (decks, tables) remain links: the site has copies of them.
    """
    here = Path(app.env.doc2path(app.env.docname)).parent
    for link in list(page.findall(addnodes.pending_xref)):
        path = link["reftarget"].partition("#")[0]
        if link.get("refdomain") == "doc":  # relative to docs/, without a suffix
            target = (DOCS / f"{path}.md").resolve()
        else:
            target = (here / path).resolve()
        if path and target.exists() and not target.is_relative_to(DOCS):
            link.replace_self(link.children)


def setup(app: Sphinx) -> dict[str, bool]:
    """Called by Sphinx."""
    app.connect("doctree-read", keep_text_of_links_out)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
