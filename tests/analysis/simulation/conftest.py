"""Fixtures: a small arm that is built, also with a compiler that compiles nothing, and FMUs of it."""

from support.fmu import openmodelica, reference
from support.simulation import arm, built_arm, compiler

__all__ = ["arm", "built_arm", "compiler", "openmodelica", "reference"]
