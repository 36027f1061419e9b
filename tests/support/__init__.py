"""Code that several tests share: the corpus, packages made from URDF, the embedded compiler, the physics reference."""
