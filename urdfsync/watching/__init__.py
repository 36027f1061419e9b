"""What `urdfsync watch` is made of: which files matter, when they have settled, and what there is to say."""
