"""The differences of Windows from other systems, in one place: programs, command lines, held files, change times."""

from __future__ import annotations

import codecs
import errno
import os
import stat
import sys
import time

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of a no-op build
if TYPE_CHECKING:
    import signal
    from collections.abc import Callable, Iterable, Sequence
    from typing import Any, TypeVar

    R = TypeVar("R")

IS_WINDOWS = sys.platform == "win32"

PATIENCE = 2.0
"""Seconds to wait for a file that another program holds: a virus scanner or an indexer takes a moment."""
_PAUSE = 0.05
_HELD = (32, 33, 1224)
"""Errors of Windows: another program holds the file open, a part of it locked, or the file in its memory."""
_DENIED = 5
"""The error of Windows for a read-only file, a file that is about to be deleted, and a folder in use."""
OUT_OF_TIME = 1816
"""The exit code of a process that a job object ends: ERROR_NOT_ENOUGH_QUOTA."""
NO_TIME = 1 << 62
"""Stands for the change time on a file system that has none: a file there counts as changed a moment ago."""


# --- programs -------------------------------------------------------------------------------------------------------


def find_program(name: str, folder: str | os.PathLike[str] = "", path: str | None = None) -> str | None:
    """Return the absolute path of a program, or None: a name is looked for on the PATH alone, a path is from `folder`.

    Windows looks into the working folder first, and so does a relative or empty entry of the PATH: there, a stranger's
    repository may have a `git.exe`. `path` is looked at in place of the PATH.
    """
    if os.path.dirname(name):
        folders, is_named = [os.path.abspath(folder)], True
    else:
        entries = (os.environ.get("PATH", os.defpath) if path is None else path).split(os.pathsep)
        folders, is_named = [entry.strip('"') for entry in entries], False
    endings = [""]
    if IS_WINDOWS:
        known = os.environ.get("PATHEXT", ".COM;.EXE;.BAT;.CMD").lower().split(os.pathsep)
        endings = [""] if name.lower().endswith(tuple(known)) else known
    for place in filter(os.path.isabs, folders):
        for file in (os.path.join(place, name + end) for end in endings):
            # the system itself says why a file cannot be run that somebody names
            if os.path.isfile(file) and (is_named or os.access(file, os.X_OK)):
                return file
    return None


def program_files(pattern: str) -> list[str]:
    """Return the paths below Windows' folder of programs that match a pattern, those of the newest version first."""
    import glob  # takes 1 ms, as below, which most commands save

    folder = os.environ.get("PROGRAMFILES")  # other systems have no such variable
    return sorted(glob.glob(os.path.join(glob.escape(folder), pattern)), reverse=True) if folder else []


def command(words: Sequence[str], folder: str | os.PathLike[str] = "") -> list[str]:
    """Return a command with the absolute path of its program. Raises FileNotFoundError if there is no such program."""
    program = find_program(words[0], folder)
    if program is None:
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), words[0])
    return [program, *words[1:]]


def split_words(line: str) -> list[str]:
    """Return the words of a command line. Raises ValueError. On Windows, a backslash belongs to a path."""
    import shlex

    if not IS_WINDOWS:
        return shlex.split(line)
    if os.path.isfile(line):  # such as `C:\Program Files\Editor\editor.exe`, without quotes
        return [line]
    lexer = shlex.shlex(line, posix=True)
    lexer.whitespace_split, lexer.escape, lexer.commenters, lexer.quotes = True, "", "", '"'
    return list(lexer)


def expand(pattern: str) -> list[str]:
    """Return the paths that a pattern of the command line names; a shell of Windows leaves this to the program."""
    import glob

    return (IS_WINDOWS and sorted(glob.glob(pattern))) or [pattern]


def join_words(words: Iterable[str]) -> str:
    """Return a command line to copy into a shell; on Windows, `cmd` and PowerShell read it alike."""
    if IS_WINDOWS:
        return " ".join(word if word and not set(word) & set(" \t'&|<>(){}^;,@`$") else f'"{word}"' for word in words)
    import shlex

    return shlex.join(words)


def own_group() -> dict[str, Any]:
    """Return arguments of `subprocess` with which Ctrl-C reaches this process, but not the new one."""
    return {"creationflags": 0x200} if IS_WINDOWS else {"process_group": 0}  # CREATE_NEW_PROCESS_GROUP


def ending_signals() -> list[signal.Signals]:
    """Return the signals that ask a program to end, except Ctrl-C: on Windows, of Ctrl-Break and a closed console."""
    import signal

    if sys.platform == "win32":
        return [signal.SIGTERM, signal.SIGBREAK]
    return [signal.SIGTERM]


# --- files ----------------------------------------------------------------------------------------------------------


def is_held(error: OSError) -> bool:
    """Return whether an error says that another program has the file open: only Windows has such errors."""
    return getattr(error, "winerror", None) in _HELD


def held_hint(error: OSError) -> str:
    """Return what to do about a file that another program has open; empty for other errors."""
    return "close it there" if is_held(error) else ""


def patiently(function: Callable[[], R]) -> R:
    """Call a function of the system; while another program holds its file, again for `PATIENCE` seconds.

    Raises OSError. The text of the error (`strerror`) then names the program, where Windows only says that it is busy.
    """
    return _repeat(function, is_held)


def replace(path: str | os.PathLike[str], target: str | os.PathLike[str]) -> None:
    """Rename a file; replace a file of the new name, even a read-only one. Raises OSError."""
    _repeat(lambda: os.replace(path, target), lambda error: is_held(error) or _is_in_the_way(error, target))


def unlink(path: str | os.PathLike[str]) -> None:
    """Remove a file, even a read-only one: on other systems, the permissions of its folder decide. Raises OSError."""
    _repeat(lambda: os.unlink(path), lambda error: is_held(error) or _is_in_the_way(error, path))


def _repeat(function: Callable[[], R], may_pass: Callable[[OSError], bool]) -> R:
    end = 0.0
    while True:
        try:
            return function()
        except OSError as error:
            end = end or time.monotonic() + PATIENCE
            if not may_pass(error) or time.monotonic() > end:
                if is_held(error):
                    path = error.filename2 or error.filename or ""
                    error.strerror = f"{find_holder(path) or 'another program'} has it open"
                raise
        time.sleep(_PAUSE)


def _is_in_the_way(error: OSError, path: str | os.PathLike[str]) -> bool:
    """Return whether Windows denies to replace or remove a file that is read-only or open; make it writable."""
    if getattr(error, "winerror", None) != _DENIED or not os.path.isfile(path):
        return False
    os.chmod(path, stat.S_IWRITE)
    return True


if sys.platform == "win32":
    import ctypes
    from ctypes import c_uint32, c_void_p, c_wchar_p

    _GENERIC_READ, _DELETE, _FILE_READ_ATTRIBUTES = 0x80000000, 0x10000, 0x80
    _SHARE_ALL, _OPEN_EXISTING, _BACKUP_SEMANTICS, _OPEN_LINK = 7, 3, 0x02000000, 0x00200000
    _FILE_BASIC_INFO = 0
    _YEAR_1970 = 116_444_736_000_000_000
    """In 100 ns since 1601."""
    _kernel = ctypes.WinDLL("kernel32", use_last_error=True)
    _kernel.CreateFileW.argtypes = c_wchar_p, c_uint32, c_uint32, c_void_p, c_uint32, c_uint32, c_void_p
    _kernel.CreateFileW.restype = c_void_p
    _kernel.GetFileInformationByHandleEx.argtypes = c_void_p, c_uint32, c_void_p, c_uint32
    _kernel.CloseHandle.argtypes = (c_void_p,)
    _MOST_HOLDERS, _RM_PROCESS_INFO, _APP_NAME = 8, 668, range(12, 524)
    """The number of entries to ask for, the size of an entry in bytes, and the place of a name in it."""
    _PROCESS_TIME, _PROCESS_MEMORY, _KILL_ON_JOB_CLOSE, _EXTENDED_LIMITS = 0x2, 0x100, 0x2000, 9
    _kernel.CreateJobObjectW.restype = _kernel.GetCurrentProcess.restype = c_void_p
    _kernel.AssignProcessToJobObject.argtypes = c_void_p, c_void_p
    _kernel.SetInformationJobObject.argtypes = c_void_p, c_uint32, c_void_p, c_uint32
    _job: int | None = None
    """The job object of this process, which ends with the process: it holds the only handle."""

    def _open(path: str, access: int, *, follow: bool = False) -> int:
        """Open a file or folder with a right that others may hold, too; return its handle. Raises OSError."""
        flags = _BACKUP_SEMANTICS | (0 if follow else _OPEN_LINK)
        handle = _kernel.CreateFileW(path, access, _SHARE_ALL, None, _OPEN_EXISTING, flags, None)
        if handle in (None, c_void_p(-1).value):
            error = ctypes.WinError(ctypes.get_last_error())
            error.filename = path
            raise error
        return int(handle)

    def _try_open(path: str, flags: int) -> int:
        try:
            return os.open(path, flags)
        except PermissionError:
            _kernel.CloseHandle(_open(path, _GENERIC_READ))  # raises the system's error, which `os.open` hides
            raise

    def open_file(path: str, flags: int) -> int:
        """Open a file as `os.open`, but wait for a moment while another program holds it. Raises OSError."""
        return patiently(lambda: _try_open(path, flags))

    def check_unheld(paths: Iterable[str]) -> None:
        """Raise OSError if another program holds one of these files so that it can't be renamed. Waits for a moment.

        A build asks this before it changes anything. On other systems, an open file can be renamed.
        """
        for path in paths:
            try:
                _kernel.CloseHandle(patiently(lambda path=path: _open(path, _DELETE)))  # type: ignore[misc]
            except FileNotFoundError:
                continue  # somebody deleted it meanwhile

    def find_holder(path: str) -> str:
        """Return the names of the programs that have a file open, as the Restart Manager knows them, or nothing."""
        manager = ctypes.WinDLL("rstrtmgr")
        session, needed, count, reasons = (c_uint32() for _ in range(4))
        if manager.RmStartSession(ctypes.byref(session), 0, ctypes.create_unicode_buffer(33)):
            return ""
        try:
            manager.RmRegisterResources(session, 1, (c_wchar_p * 1)(path), 0, None, 0, None)
            count.value = _MOST_HOLDERS
            found = ctypes.create_string_buffer(_MOST_HOLDERS * _RM_PROCESS_INFO)
            sizes = ctypes.byref(needed), ctypes.byref(count)
            if manager.RmGetList(session, *sizes, found, ctypes.byref(reasons)):
                return ""
            starts = range(_APP_NAME.start, count.value * _RM_PROCESS_INFO, _RM_PROCESS_INFO)
            names = (found.raw[start : start + len(_APP_NAME)].decode("utf-16").partition("\0")[0] for start in starts)
            return " and ".join(dict.fromkeys(filter(None, names)))
        finally:
            manager.RmEndSession(session)

    def limit_process(seconds: float, memory: int) -> None:
        """Limit this process and its children to `seconds` more of user time and `memory` (bytes); 0 lifts a limit.

        A process over its time ends with the code `OUT_OF_TIME`, one over its memory gets no more. The children end
        with the process. Raises OSError.
        """
        global _job
        if not _job:
            _job = _kernel.CreateJobObjectW(None, None)
            if not _kernel.AssignProcessToJobObject(_job, _kernel.GetCurrentProcess()):
                raise ctypes.WinError(ctypes.get_last_error())
        limits = (ctypes.c_uint64 * 18)()  # JOBOBJECT_EXTENDED_LIMIT_INFORMATION
        limits[0] = int((os.times().user + seconds) * 1e7)
        limits[2] = _KILL_ON_JOB_CLOSE | (_PROCESS_TIME if seconds else 0) | (_PROCESS_MEMORY if memory else 0)
        limits[14] = memory
        if not _kernel.SetInformationJobObject(_job, _EXTENDED_LIMITS, limits, ctypes.sizeof(limits)):
            raise ctypes.WinError(ctypes.get_last_error())

    def pipe_encoding(encoding: str) -> str:
        """Return the encoding for a pipe or a file that Python writes in `encoding`.

        Python takes the code page of Windows (1252), but PowerShell reads a pipe in that of its console (850): `ü` in
        the name of a user would be another letter in the line of `urdfsync library`.
        """
        page = f"cp{_kernel.GetConsoleOutputCP()}"
        if encoding != f"cp{_kernel.GetACP()}":  # the user has chosen another one
            return encoding
        try:
            return codecs.lookup(page).name
        except LookupError:  # there is no console, which has page 0
            return encoding

    def change_time(path: str, status: os.stat_result, *, follow: bool = False) -> int:  # noqa: ARG001 - see below
        """Return the time (ns) of the last change of a file's content or status, which is `st_ctime` elsewhere.

        On Windows, `st_ctime` is the time of the creation. NTFS has the change time, too; FAT has none (`NO_TIME`).
        """
        try:
            handle = _open(path, _FILE_READ_ATTRIBUTES, follow=follow)
        except OSError:
            return NO_TIME
        times = (ctypes.c_int64 * 5)()  # of creation, access, write and change, in 100 ns; then the attributes
        is_known = _kernel.GetFileInformationByHandleEx(handle, _FILE_BASIC_INFO, times, ctypes.sizeof(times))
        _kernel.CloseHandle(handle)
        return (times[3] - _YEAR_1970) * 100 if is_known and times[3] else NO_TIME

else:

    def open_file(path: str, flags: int) -> int:
        """Open a file."""
        return os.open(path, flags)

    def find_holder(path: str) -> str:  # noqa: ARG001
        """Return nothing: an open file can be read and replaced."""
        return ""

    def check_unheld(paths: Iterable[str]) -> None:
        """Do nothing: an open file can be renamed."""

    def pipe_encoding(encoding: str) -> str:
        """Return the encoding as it is."""
        return encoding

    def change_time(path: str, status: os.stat_result, *, follow: bool = False) -> int:  # noqa: ARG001
        """Return the time (ns) of the last change of a file's content or status."""
        return status.st_ctime_ns
