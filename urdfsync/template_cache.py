"""Jinja's cache of compiled templates, in the user's cache folder.

It serves the row "first build, 11 links" of docs/speed.md: compiling takes a third of such a build.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
import sys
from pathlib import Path

import jinja2
import platformdirs

from urdfsync.modelica import literals


class TemplateCache(jinja2.FileSystemBytecodeCache):
    """Compiled templates in a folder; several processes may use it at once.

    Its files are code that is run: those that others may write to are not read, and damaged ones are made again.
    """

    def load_bytecode(self, bucket: jinja2.bccache.Bucket) -> None:
        """See Jinja."""
        try:
            if _is_private(Path(self.directory, self.pattern % bucket.key).stat()):
                super().load_bytecode(bucket)
        except FileNotFoundError:
            return
        except Exception:  # noqa: BLE001 - Jinja unpickles, and a damaged pickle may raise anything
            bucket.reset()

    def dump_bytecode(self, bucket: jinja2.bccache.Bucket) -> None:
        """See Jinja; where nothing can be written, the template is compiled each time."""
        with contextlib.suppress(OSError):
            super().dump_bytecode(bucket)


def find_cache(environment: type[jinja2.Environment]) -> TemplateCache | None:
    """Find the cache for templates of such an environment, and make its folder.

    None if somebody else may write to the folder or replace it, so that all templates are compiled each time.
    """
    folder = platformdirs.user_cache_path("urdfsync", appauthor=False) / "templates"
    if not folder.is_absolute():
        return None
    try:
        for each in (*reversed(folder.parents), folder):
            if not each.exists():
                each.mkdir(mode=0o700, exist_ok=True)
        own = (folder, folder.parent)
        above = (*folder.parent.parents, *folder.resolve().parents)
        is_safe = all(_is_private(each.stat()) for each in own) and all(_is_safe_above(each.stat()) for each in above)
    except OSError:
        return None
    if not is_safe:
        return None
    # All that decides what a template is compiled to, beside its text and the version of Python: calls, loops and
    # operators are compiled for one kind of sandbox, and filters are applied to constants then.
    kind = environment.sandboxed, environment.__qualname__, sorted(getattr(environment, "intercepted_binops", ()))
    here = Path(__file__)
    files = (Path(jinja2.__file__), Path(literals.__file__), here, here.with_name("render.py"))
    stats = [(str(file), file.stat().st_size, file.stat().st_mtime_ns) for file in files]
    fingerprint = hashlib.sha256(repr((kind, sys.version, stats)).encode()).hexdigest()[:16]
    return TemplateCache(str(folder), f"{fingerprint}-%s")


def _is_private(status: os.stat_result) -> bool:
    """Whether only this user may write to a file or folder. On Windows, users' folders are their own anyway."""
    return not hasattr(os, "getuid") or (status.st_uid == os.getuid() and not status.st_mode & 0o022)


def _is_safe_above(status: os.stat_result) -> bool:
    """Whether only this user and root may replace what is theirs in a folder: others may not with the sticky bit."""
    if not hasattr(os, "getuid"):
        return True
    return status.st_uid in (os.getuid(), 0) and (not status.st_mode & 0o022 or bool(status.st_mode & stat.S_ISVTX))
