"""A project on disk: its configuration, its recorded state, and its repository."""
