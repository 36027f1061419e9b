"""The data of templates, made from a robot."""
