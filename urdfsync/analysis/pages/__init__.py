"""Pages: a robot in 3D, its tree and diagram, its changes, and the user's edits."""
