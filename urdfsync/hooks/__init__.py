"""The hooks of git: what is being committed is checked against what a build of it would write."""
