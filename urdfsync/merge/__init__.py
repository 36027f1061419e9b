"""Three-way merge of generated text with hand edits; the same result on every machine."""

from urdfsync.merge.texts import Merge, merge

__all__ = ["Merge", "merge"]
