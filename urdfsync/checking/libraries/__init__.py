"""The Modelica libraries that a package needs: where they are, and which part of them."""
