"""Compare two versions of a model: classified changes, their outline, and versions from files and git revisions."""
