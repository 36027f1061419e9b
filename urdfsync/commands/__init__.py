"""The commands of the command line: each one adds its parser, calls the API, and returns an exit code."""
