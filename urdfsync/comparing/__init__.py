"""What `diff` compares and how: two versions of a source, and what their differences mean to people."""
