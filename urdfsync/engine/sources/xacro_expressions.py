"""Evaluates expressions of xacro.

Expressions are Python, so this checks their syntax tree first: they can't reach other code. Expressions use numbers,
texts, lists and dictionaries, and call documented functions of xacro. Expressions may read attributes of these values
only. Attributes of other objects, such as the frame of a generator, lead to all of Python.
"""

from __future__ import annotations

import ast
import functools
import string
from collections.abc import Callable, Mapping, MutableMapping, Sequence
from types import CodeType
from typing import Any

import xacro
from xacro import substitution_args

_ALLOWED: tuple[type[ast.AST], ...] = (
    *(ast.Expression, ast.Constant, ast.Name, ast.expr_context, ast.Attribute, ast.Subscript, ast.Slice),
    *(ast.BinOp, ast.operator, ast.UnaryOp, ast.unaryop, ast.BoolOp, ast.boolop, ast.Compare, ast.cmpop, ast.IfExp),
    *(ast.List, ast.Tuple, ast.Dict, ast.Set, ast.Call, ast.keyword, ast.Starred, ast.Lambda, ast.arguments, ast.arg),
    *(ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp, ast.comprehension),
)
_BUILTINS = frozenset(
    "list dict map len str float int bool True False min max round sorted range abs all any complex divmod enumerate "
    "filter frozenset hash isinstance issubclass ord repr reversed slice set sum tuple zip".split()
)
"""The functions of xacro's `python`, except `type` and `vars`: with these, an expression could reach other code."""
_VALUES = frozenset(
    {str, int, float, complex, bool, list, dict, tuple, set, frozenset, xacro.YamlListWrapper, xacro.YamlDictWrapper}
)
"""Types with safe methods: these work only with values."""
_HIDDEN = frozenset({"format_map", "mro"})
"""Public attributes of these types that lead to other objects."""
_GET = "__attribute"


class ForbiddenError(Exception):
    """An expression has a part that could reach other code."""


class _Reader(ast.NodeTransformer):
    """Refuses forbidden parts of an expression, and replaces the reading of attributes by calls of `_attribute`."""

    def visit(self, node: ast.AST) -> Any:
        """Read a part of an expression. Raises ForbiddenError."""
        if not isinstance(node, _ALLOWED):
            raise ForbiddenError(f"this is not allowed in an expression: {type(node).__name__}")
        if isinstance(node, (ast.Attribute, ast.Subscript)) and not isinstance(node.ctx, ast.Load):
            raise ForbiddenError("an expression may not assign")
        return super().visit(node)

    def visit_Name(self, node: ast.Name) -> ast.Name:
        """Refuse a name of Python's own. A name with one leading `_` is allowed: only properties have such names."""
        _check_name(node.id)
        return node

    def visit_arg(self, node: ast.arg) -> ast.arg:
        """Refuse names of Python's own for arguments."""
        _check_name(node.arg)
        return node

    def visit_Attribute(self, node: ast.Attribute) -> ast.Call:
        """Replace `a.b` by a call of `_attribute`."""
        if node.attr.startswith("_"):
            raise ForbiddenError(f"the attribute `{node.attr}` is not allowed in an expression")
        arguments: list[ast.expr] = [self.visit(node.value), ast.Constant(node.attr)]
        return ast.Call(ast.Name(_GET, ast.Load()), arguments, [])


def _check_name(name: str) -> None:
    if name.startswith("__"):
        raise ForbiddenError(f"the name `{name}` is not allowed in an expression")


class _Formatter(string.Formatter):
    """Formats like `str.format`, but reads no attributes."""

    def get_field(self, field_name: str, args: Sequence[Any], kwargs: Mapping[str, Any]) -> Any:
        """Return the value of a field. Raises ForbiddenError."""
        if "." in field_name:
            raise ForbiddenError(f"`{{{field_name}}}` reads an attribute, which a format may not")
        return super().get_field(field_name, args, kwargs)


def _attribute(value: Any, name: str) -> Any:
    """Return an attribute of a value or of a namespace. Raises ForbiddenError for other objects."""
    if isinstance(value, xacro.NameSpace):
        return value.__getattr__(name)  # `value.name` finds the methods of its class first
    kind = value if isinstance(value, type) else type(value)
    if kind not in _VALUES or name in _HIDDEN or (value is str and name == "format"):
        raise ForbiddenError(f"an expression may not read `{name}` of a {kind.__name__}")
    if kind is str and name == "format":
        return functools.partial(_Formatter().format, value)
    return getattr(value, name)


@functools.lru_cache(maxsize=10_000)
def _compile(text: str) -> CodeType:
    """Compile an expression once: macros repeat it. Raises ForbiddenError, SyntaxError."""
    tree = _Reader().visit(ast.parse(text, "<expression>", "eval"))
    code: CodeType = compile(ast.fix_missing_locations(tree), "<expression>", "eval")
    return code


def evaluate(text: str, names: MutableMapping[str, Any], _locals: None = None) -> Any:
    """Evaluate an expression that knows only these names. Raises ForbiddenError, and all errors of the expression."""
    names.update({"__builtins__": {_GET: _attribute}})
    return eval(_compile(text.strip()), names)  # type: ignore[arg-type] # noqa: S307 - `_compile` has checked it


def _substitute(text: str, context: Mapping[str, Mapping[str, str]]) -> str:
    """Evaluate `$(eval …)`; its names are the arguments."""
    convert: Callable[[str, str], Any] = substitution_args.convert_value
    arguments = {name: convert(value, "auto") for name, value in context.get("arg", {}).items()}
    return str(evaluate(text, {**xacro._global_symbols, "true": True, "false": False, **arguments}))


def install() -> None:
    """Make xacro use this module for its expressions, in this process."""
    python = xacro._global_symbols["python"]
    for name in python.keys() - _BUILTINS:
        dict.pop(python, name)
    xacro.safe_eval = evaluate
    substitution_args._eval = _substitute
