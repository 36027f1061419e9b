"""Finds texts of the user's that follow a rename, although their base does not show it: by names that are missing now.

Such a text is a class of the user's own in the package, an edit of a file whose generated text stays the same, or an
edit that git has merged with the rename of another branch.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from urdfsync.engine.fit import Misfit, find_misfits
from urdfsync.engine.package_after import PackageAfter
from urdfsync.engine.package_names import declared_names, new_name
from urdfsync.merge.renames import rename


def find_followers(
    after: PackageAfter, keys: Collection[str], renamed: Mapping[str, str]
) -> dict[str, tuple[str, str]]:
    """Return the text, and the text with new names, of those files of `keys` that can follow, by key.

    `renamed` has new identifiers by old identifiers. A name follows if it is missing, and if its new name exists at the
    same place. A text that declares the old name itself does not follow.
    """
    names = dict[str, dict[str, list[Misfit]]]()
    for misfit in find_misfits(after):
        if misfit.key in keys and misfit.use and new_name(misfit.use.part, renamed, misfit.use.candidates):
            names.setdefault(misfit.key, {}).setdefault(misfit.use.part, []).append(misfit)
    found = dict[str, tuple[str, str]]()
    for key, misfits in names.items():
        text = after.merged.get(key) or after.inputs.files.text(key) or ""
        lines, own, news = text.splitlines(), declared_names([text]), dict[str, str]()
        for part, uses in misfits.items():
            candidates = {name for one in uses if one.use for name in one.use.candidates}
            if part not in own:
                news[part] = new_name(part, renamed, candidates)
        used = "\n".join(lines[one.finding.line - 1] for uses in misfits.values() for one in uses)
        found[key] = text, rename(used, text, news)[1]
    texts = {key: new for key, (text, new) in found.items() if new != text}
    if not texts:
        return {}
    merged = {**after.merged, **texts}
    followed = PackageAfter(after.inputs, after.package, after.actions, merged, is_open=after.is_open)
    lost = {one.key for one in find_misfits(followed) if one.use and one.use.part in names.get(one.key, ())}
    return {key: found[key] for key in texts.keys() - lost}
