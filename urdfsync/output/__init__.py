"""What several commands show, to people and to programs."""
