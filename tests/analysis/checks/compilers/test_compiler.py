"""What a compiler has to be, and the text of a model that is compiled by itself."""

from __future__ import annotations

import inspect

import pytest

from urdfsync.analysis.checks.compilers import COMPILERS
from urdfsync.analysis.checks.compilers.compiler import Compiler, compile_task, one_line


@pytest.mark.parametrize("name", COMPILERS)
def test_each_is_as_the_protocol_says(name: str) -> None:
    module = COMPILERS[name]
    for constant, kind in inspect.get_annotations(Compiler, eval_str=True).items():
        assert type(getattr(module, constant)) in (kind, getattr(kind, "__origin__", None)), constant
    for function in [member for member in vars(Compiler).values() if inspect.isfunction(member)]:
        if not function.__name__.startswith("_"):
            _self, *parameters = inspect.signature(function).parameters
            assert list(inspect.signature(getattr(module, function.__name__)).parameters) == parameters, function


def test_a_model_is_compiled_by_a_text_that_names_its_library_once() -> None:
    task = compile_task("Arm.Joints.Elbow", ("Modelica", "Arm"))
    imports = "  import Modelica;\n  import Arm;\n"
    assert task.source == f"model Probe_\n{imports}  extends Arm.Joints.Elbow;\nend Probe_;\n"
    assert "  import Plant;\n" in compile_task("Plant.Arm").source
    assert (task.model, task.title, one_line(" a\n\tb ")) == ("Probe_", "Arm.Joints.Elbow", "a b")
