"""The commands of the command line: each adds its parser, and turns arguments into calls and an exit code."""
