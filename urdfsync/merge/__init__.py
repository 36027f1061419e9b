"""Three-way merge of generated text with hand edits; the same result on every machine."""

from urdfsync.merge.lines import Conflict, Merge, merge, split_lines

__all__ = ["Conflict", "Merge", "merge", "split_lines"]
