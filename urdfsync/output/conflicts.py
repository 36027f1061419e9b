"""Shows conflicts: what both sides changed, and the commands that settle them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from urdfsync.common import system
from urdfsync.common.spelling import counted, same_count
from urdfsync.engine.actions import Choice, Reason
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.result import DisputedFile, Result
from urdfsync.modelica.markers import find_markers
from urdfsync.output.console import Console, StyledLine, line
from urdfsync.output.phrases import NEW_NAMES, reason

FULL = 3
"""The greatest number of conflicts of a robot that are shown in full without --verbose."""
LINES = 16
"""The greatest number of lines of a conflict that are shown without --verbose."""
_CONTEXT = 2
"""Unchanged lines that are shown around a difference."""
_WIDTH = 240
"""The greatest number of characters of a line that are shown."""
_ELEMENTS = 5
"""The greatest number of changes of each side that are listed."""
_SIGNS = {"+": "green", "-": "red", "@": "cyan"}
"""Styles of the lines of a difference, by the first characters of a line."""
_SIDES = {
    Choice.MERGE_MINE: ("mine", "yours"),
    Choice.MERGE_GENERATED: ("generated", "the generated ones"),
    Choice.MERGE_THEIRS: ("theirs", "theirs"),
}
"""The sides that `--prefer` names, each with its word in sentences."""


def conflict_lines(result: Result, console: Console) -> Iterator[StyledLine]:
    """Yield all conflicts of one robot, the first ones in full, others on a line each, and the command for all."""
    conflicts = result.conflicts
    full = len(conflicts) if console.verbose else 0 if console.quiet else FULL
    menus = list[dict[str, str]]()
    for target in conflicts[:full]:
        menu = _choices(target)
        yield line(("", ""))
        yield from _full_lines(target, console, menu)
        if menu not in menus:  # the same choices are explained only once
            width = max(map(len, menu))
            yield from (line((f"      {choice:<{width}}  {words}", "dim")) for choice, words in menu.items())
            menus.append(menu)
    if full and conflicts[full:]:
        yield line(("", ""))
    for target in conflicts[full:]:
        yield line(("  conflict   ", "bold red"), (target.shown, ""), (f"  {target.relation}", "dim"))
    if len(conflicts) == 1 and full:
        return
    mergeable = sum(target.merges for target in conflicts)
    option = "--merge"
    what = "merges it" if len(conflicts) == 1 else f"merges what can be merged: {mergeable} of {len(conflicts)}"
    if all(next(iter(_choices(target))) == "--moved" for target in conflicts):
        option, what = "--moved", "moves each edit to its likely file"
    elif not mergeable and not all("--keep" in _choices(target) for target in conflicts):
        return  # git's markers can't be kept
    elif not mergeable:
        option, what = "--keep", "keeps all your files as they are; --take replaces them by the generated ones"
    command = ["resolve", result.robot, option]
    yield from (line(("", "")), line((f"  {_command(command, console)}", "bold"), (f"  {what}", "dim")))
    never_built = all(action.base is None for action in result.actions)
    if never_built and all(target.action.reason is Reason.UNOWNED for target in conflicts):
        what = "takes the files for your edits, and lists them"
        yield line((f"  {_command(['adopt', result.robot], console)}", "bold"), (f"  {what}", "dim"))


def _full_lines(target: DisputedFile, console: Console, choices: Mapping[str, str]) -> Iterator[StyledLine]:
    """Yield lines about one conflict: the reason, the differences, the saved versions, and the first choice."""
    result, action, name = target.result, target.action, target.shown
    yield line(("  conflict   ", "bold red"), (name, "bold"), (f"  {action.owner}", "dim"))
    clauses = [reason(action, result.changes), target.relation]
    clauses += [f"it will be moved to {result.shown(action.path)}"] if action.origin else []
    yield from (line((f"    {_sentence(clause)}", "")) for clause in clauses)
    if target.texts:
        saved = {kind: result.shown(path) for kind, path in target.saved.items()}
        lines = [] if console.verbose else _element_lines(target.texts)
        lines = lines or list(_text_lines(target.texts))
        most = len(lines) if console.verbose else LINES
        yield from (line(("", "")), *lines[:most])
        if rest := len(lines[most:]):
            see = "--verbose shows them" if result.dry else f"see {saved.get('merge', saved['generated'])}"
            yield line((f"    … {counted(rest, 'more line')}; {see}", "dim"))
        yield line(("", ""))
        if not result.dry:
            folder = Path(saved["generated"]).parent
            yield line((f"    saved in {folder}: {', '.join(Path(path).name for path in saved.values())}", "dim"))
    best = next(iter(choices)).split()
    files = [f"./{file}" if file.startswith("-") else file for file in _files_to_name(target, best)]
    yield line((f"    {_command(['resolve', *files, *best], console)}", "bold"))


def settle_hint(conflicts: Sequence[DisputedFile]) -> str:
    """Return a hint with the options of `resolve` that settle each of these conflicts."""
    moved = [target for target in conflicts if _is_likely_moved(target)]
    if moved and (unmoved := [target for target in conflicts if not _is_likely_moved(target)]):
        return f"{settle_hint(moved)}; {settle_hint(unmoved)}"
    first, *others = map(_choices, conflicts)
    best, *more = [choice for choice in first if all(choice in choices for choices in others)]
    files = dict.fromkeys(file for target in conflicts for file in _files_to_name(target, [best]))
    what, file = ("each conflict" if others else "the conflict"), " ".join(files) if moved or not others else "FILE"
    or_more = f" (or {', '.join(more)})" if more else ""
    merges = sum("--merge" in choices for choices in (first, *others))
    and_merge = f"; --merge settles {merges} of {len(conflicts)}" if 0 < merges < len(conflicts) else ""
    return f"settle {what} with `urdfsync resolve {file} {best}`{or_more}{and_merge}"


def _choices(target: DisputedFile) -> dict[str, str]:
    """Return the options that settle a conflict, best first, with their effects."""
    texts, is_on_disk = target.texts, target.action.is_on_disk
    choices, is_users = {}, target.action.generated is None and target.action.reason is Reason.RENAMED
    if target.action.reason is Reason.SECOND:
        merged = f"your edits of both files, in {target.action.copy_of}"
        return {"--moved": merged, "--keep": "it is a class of your own", "--take": "deletes the file"}
    if target.merges:
        choices["--merge"] = NEW_NAMES if is_users else "both sides' changes"
    elif sides := [side for choice, side in _SIDES.items() if target.offers(choice)]:
        either = f" (or `{sides[1][0]}`)" if sides[1:] else ""
        choices[f"--merge --prefer {sides[0][0]}"] = f"both sides' changes; {sides[0][1]}{either} where they contradict"
    if target.action.reason is Reason.ASKED and " " not in target.action.owner:
        choices = {"--keep": "your file as it is: its names are right"}
    elif texts and _is_likely_moved(target):
        choices = {"--moved": f"your edit belongs to `{texts.moved_to}`", "--keep": "it is the same part"}
    elif target.action.reason is Reason.ASKED:
        choices = {"--keep": "it is the same part", "--moved NAME": "your edit belongs to the part of this name"}
    if target.action.reason is Reason.ASKED:
        return choices | {"--take": "the generated file"}
    edit = {"--edit": "both sides in your editor, between markers"} if texts and is_on_disk else {}
    keep = {"--keep": f"your file as it is{', under its new name' if target.action.origin else ''}"}
    if texts and find_markers(texts.mine):  # a text with markers can't be kept
        keep = {}
    choices |= {**edit, **keep} if texts and texts.merge else {**keep, **edit}
    return choices | ({"--take": "the generated file"} if is_on_disk and not is_users else {})


def _is_likely_moved(target: DisputedFile) -> bool:
    """Return whether an edit may belong to another part, and its likely name is known."""
    return target.action.reason is Reason.ASKED and target.texts is not None and target.texts.moved_to != ""


def _files_to_name(target: DisputedFile, choice: Sequence[str]) -> list[str]:
    """Return the files that one command names for a choice: --moved can't move an edit over another doubtful edit."""
    if choice != ["--moved"] or not _is_likely_moved(target):
        return [target.shown]
    moved = {(one.action.role, one.action.owner): one for one in target.result.conflicts if _is_likely_moved(one)}
    files, following = list[str](), moved.get((target.action.role, target.action.owner))
    while following and following.texts and following.shown not in files:
        files.append(following.shown)
        kind = following.action.owner.partition(" ")[0]
        following = moved.get((following.action.role, f"{kind} {following.texts.moved_to}"))
    return files


# --- the lines at issue -------------------------------------------------------------------------------------------


def _element_lines(texts: Conflict) -> list[StyledLine]:
    """Return the changes of each side by element, if none contradicts another and both texts are classes."""
    from urdfsync.merge.edits import find_edits, in_words  # only conflicts need the merge
    from urdfsync.merge.renames import rename

    if texts.base is None or texts.merge is None or texts.merge.contradictions or texts.merge.flaw:
        return []
    sides = {"you": find_edits(texts.base, texts.mine)}
    if texts.base == texts.generated:  # only names changed
        sides["the export"] = find_edits(texts.mine, texts.merge.proposal)
    else:
        renamed_base, _ = rename(texts.base, "", texts.names)
        sides["the export"] = find_edits(renamed_base, texts.generated)
    if texts.base == texts.mine:  # a class of the user's own
        del sides["you"]
    lines: list[StyledLine] = []
    for side, edits in sides.items():
        if edits is None:
            return []
        renamed = texts.renamed if side == "the export" else ""
        if renamed:  # new names bring new descriptions and other lines in the diagram
            edits = [edit for edit in edits if not (edit.is_for_readers or edit.part == "layout")]
        told = [f"{element}: {what}" for element, what in in_words(edits)]
        told = told or [renamed or "blanks, or the order of things"]
        more = [f"… {counted(len(told) - _ELEMENTS, 'more change')}"] if len(told) > _ELEMENTS else []
        for number, words in enumerate([*told[:_ELEMENTS], *more]):
            lines.append(line((f"    {'' if number else side:<12}", "bold"), (words, "")))
    return lines


def _text_lines(texts: Conflict) -> Iterator[StyledLine]:
    """Yield contradictions between markers, as in `--edit`; without contradictions, the changes of the merge."""
    if texts.merge is None:
        return difference_lines(texts.mine, texts.generated, "mine", "generated")
    old = (texts.merge.contradictions and texts.merge.with_mine) or texts.mine  # without contradictory changes
    return difference_lines(old, texts.merge.proposal, "mine", "merge")


def difference_lines(old: str, new: str, old_name: str, new_name: str) -> Iterator[StyledLine]:
    """Yield the difference of two texts, in git's form. Long lines that begin alike are shown where they differ."""
    import difflib  # takes 1 ms, and few builds have conflicts

    texts = _split_lines(old), _split_lines(new)
    lines = [*difflib.unified_diff(*texts, old_name, new_name, lineterm="", n=_CONTEXT)]
    alike = defaultdict[str, set[str]](set)
    for text in lines:
        alike[text[1:_WIDTH]].add(text[1:])
    for text in lines:
        group = alike[text[1:_WIDTH]]
        begin = max(1, same_count(min(group), max(group)) - _WIDTH // 4) if len(group) > 1 else 1
        plain = (text if begin == 1 else f"{text[0]}…{text[begin:]}").replace("\t", "    ")
        yield line((f"    {plain if len(plain) <= _WIDTH else f'{plain[: _WIDTH - 1]}…'}", _SIGNS.get(text[:1], "dim")))


def _split_lines(text: str) -> list[str]:
    """Return the lines of a text; as in git, only a line feed ends one."""
    return text.replace("\r\n", "\n").removesuffix("\n").split("\n")


# --- words --------------------------------------------------------------------------------------------------------


def _command(arguments: Sequence[str], console: Console) -> str:
    """Return a command line to copy."""
    command = ["urdfsync", *arguments, *(["--config", console.config] if console.config else [])]
    return system.join_words(command)


def _sentence(clause: str) -> str:
    """Return the clause as a sentence; the name `urdfsync` keeps its small letter."""
    return f"{clause if clause.startswith('urdfsync') else clause[:1].upper() + clause[1:]}."
