"""Three-way merge of generated text with hand edits; the same result on every machine."""

from urdfsync.merge.lines import ChangedLines, find_changes, split_lines
from urdfsync.merge.texts import ConflictingLines, Merge, merge

__all__ = ["ChangedLines", "ConflictingLines", "Merge", "find_changes", "merge", "split_lines"]
