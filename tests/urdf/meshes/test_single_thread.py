"""numpy is loaded with one thread, and nobody else's environment is changed."""

from __future__ import annotations

import os

import pytest

from urdfsync.urdf.meshes.single_thread import VARIABLE, single_thread


def test_the_variable_holds_within_the_context_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE, raising=False)
    with single_thread():
        assert os.environ[VARIABLE] == "1"
    assert VARIABLE not in os.environ


def test_a_number_of_the_users_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, "3")
    with single_thread():
        assert os.environ[VARIABLE] == "3"
    assert os.environ[VARIABLE] == "3"
