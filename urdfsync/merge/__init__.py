"""Three-way merge of generated text with hand edits; the same result on every machine."""

from urdfsync.merge.lines import ConflictingLines, Merge, merge, split_lines

__all__ = ["ConflictingLines", "Merge", "merge", "split_lines"]
