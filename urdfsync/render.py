"""Templates to text: the Jinja environment, with the literals of Modelica as filters.

Modelica uses braces for arrays, so the delimiters are `<< >>`, `<% %>` and `<# #>`. Every string
that comes from a source reaches Modelica through `string` or `html`, every number through `real`,
`vector` or `matrix`: no value can end a literal or a line.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, MutableMapping, Sequence
from pathlib import Path
from typing import Any

import jinja2

from urdfsync import bytecode
from urdfsync.domain import Piece, Recipe
from urdfsync.modelica import literals


def once(pieces: Iterable[Any], macro: Callable[[Any], str]) -> str:
    """What the macro makes of some pieces, one after the other, or of something that nobody keeps.

    The macro must be one that is imported: the others are made anew for each text.
    """
    texts: list[str] = []
    for piece in pieces:
        known = piece.rendered if type(piece) is Piece else None
        texts.append(known[1] if known and known[0] is macro else _text(piece, macro))
    return "".join(texts)


def _text(piece: Any, macro: Callable[[Any], str]) -> str:
    """What the macro makes of a piece, which keeps it, or of something else; of a recipe by what it makes."""
    of = piece.of if isinstance(piece, Piece) else piece
    text = macro(of.make(*of.made_of) if isinstance(of, Recipe) else of)
    if isinstance(piece, Piece):
        piece.rendered = macro, text
    return text


_FILTERS = (
    once,
    literals.real,
    literals.vector,
    literals.matrix,
    literals.string,
    literals.html,
    literals.capitalize_first,
)
"""Filters of the same names."""


class _Environment(jinja2.Environment):
    """Jinja's, quicker where it spends more time than templates do: thousands of small texts are rendered.

    A template is looked for once, its globals are one mapping, and `x.y` is tried as an item first where `x` is a dict.
    """

    def __init__(self, **settings: Any) -> None:
        self._found: dict[str, jinja2.Template] = {}
        super().__init__(**settings)

    def get_template(
        self,
        name: str | jinja2.Template,
        parent: str | None = None,
        globals: MutableMapping[str, Any] | None = None,  # noqa: A002 - Jinja's word
    ) -> jinja2.Template:
        """See Jinja; templates that include others ask for these each time."""
        if not isinstance(name, str) or globals:
            return super().get_template(name, parent, globals)
        if name not in self._found:
            self._found[name] = super().get_template(name, parent)
        return self._found[name]

    def make_globals(self, d: MutableMapping[str, Any] | None) -> MutableMapping[str, Any]:
        """See Jinja, which chains two mappings; each text begins with a copy of it."""
        return {**self.globals, **(d or {})}

    def getattr(self, obj: Any, attribute: str) -> Any:
        """See Jinja; that a dict has no such attribute would cost an exception."""
        try:
            return obj[attribute] if type(obj) is dict else getattr(obj, attribute)
        except (AttributeError, KeyError):
            return super().getattr(obj, attribute)


class Renderer:
    """Renders templates from `folders`; a template in an earlier folder hides one of its name in a later.

    Whoever changes a template needs another renderer.
    """

    def __init__(self, folders: Sequence[Path]) -> None:
        self.folders = tuple(folders)
        self._environment = _Environment(
            loader=jinja2.FileSystemLoader([str(folder) for folder in folders]),
            variable_start_string="<<",
            variable_end_string=">>",
            block_start_string="<%",
            block_end_string="%>",
            comment_start_string="<#",
            comment_end_string="#>",
            undefined=jinja2.StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
            keep_trailing_newline=True,
            auto_reload=False,
            bytecode_cache=bytecode.of_user(),
            autoescape=False,  # Modelica, not HTML; the filters above escape
        )
        self._environment.filters.update({function.__name__: function for function in _FILTERS})

    def render(self, template: str, data: Mapping[str, Any]) -> str:
        """The template's text with `data`. Raises jinja2.TemplateError for a template that can't be used."""
        return self._environment.get_template(template).render(data)
