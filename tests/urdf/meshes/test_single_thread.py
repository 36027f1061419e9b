"""numpy is loaded with one thread, and nobody else's environment is changed."""

from __future__ import annotations

import os

import pytest

from urdfsync.urdf.meshes.single_thread import VARIABLE, single_thread


def test_a_number_of_the_users_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, "3")
    with single_thread():
        assert os.environ[VARIABLE] == "3"
    assert os.environ[VARIABLE] == "3"
