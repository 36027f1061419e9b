"""Templates to text: the Jinja environment, with the literals of Modelica as filters.

Modelica uses braces for arrays, so the delimiters are `<< >>`, `<% %>` and `<# #>`. Every string
that comes from a source reaches Modelica through `string` or `html`, every number through `real`,
`vector` or `matrix`: no value can end a literal or a line.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import jinja2

from urdfsync import bytecode, literals

_FILTERS = (
    literals.real,
    literals.vector,
    literals.matrix,
    literals.string,
    literals.html,
    literals.capitalize_first,
)
"""Filters of the same names."""


class Renderer:
    """Renders templates from `folders`; a template in an earlier folder hides one of its name in a later."""

    def __init__(self, folders: Sequence[Path]) -> None:
        self.folders = tuple(folders)
        self._environment = jinja2.Environment(
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
            bytecode_cache=bytecode.of_user(),
            autoescape=False,  # noqa: S701 - Modelica, not HTML; the filters above escape
        )
        self._environment.filters.update({function.__name__: function for function in _FILTERS})

    def render(self, template: str, data: Mapping[str, Any]) -> str:
        """The template's text with `data`. Raises jinja2.TemplateError for a template that can't be used."""
        return self._environment.get_template(template).render(data)
