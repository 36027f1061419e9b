"""Pages to look at: a robot in 3D, its tree and diagram, what changed, and what the user edited."""
