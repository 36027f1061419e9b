"""Completion in shells: the scripts, and the program that answers them."""
