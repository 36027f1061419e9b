"""Three-way merge of generated texts and hand edits, with the same result on every machine."""

from urdfsync.merge.texts import Merge, merge

__all__ = ["Merge", "merge"]
