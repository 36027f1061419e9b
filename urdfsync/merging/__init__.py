"""The parts of the three-way merge: line differences, tokens, and the rules by which edits of tokens meet."""
