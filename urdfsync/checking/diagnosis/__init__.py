"""What is wrong with a package, as findings with file and line: by its texts alone, and by what a compiler says."""
