"""What is being committed: staged sources against staged outputs, for the hooks of git."""
