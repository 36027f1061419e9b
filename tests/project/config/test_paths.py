"""Folders: the working one, those of ROS, and those of what urdfsync brings along."""

from __future__ import annotations

import os
from pathlib import Path
from unittest import mock

import pytest
from support.commands import Execute


def test_a_working_folder_that_is_gone(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "getcwd", mock.Mock(side_effect=FileNotFoundError(2, "No such file or directory")))
    for command in ("build", "init"):
        message = "error: the working folder does not exist any more; change to a folder that exists [no-folder]\n"
        assert execute(command, code=2).err == message
