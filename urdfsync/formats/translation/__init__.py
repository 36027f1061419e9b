"""Code that the translators of other formats into URDF share."""
