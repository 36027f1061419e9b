"""Three-way merge of generated text with hand edits; the same result on every machine."""

from urdfsync.merge.lines import ChangedLines, ConflictingLines, Merge, find_changes, merge, split_lines

__all__ = ["ChangedLines", "ConflictingLines", "Merge", "find_changes", "merge", "split_lines"]
