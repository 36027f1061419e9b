"""The URDF domain: robots described in the Unified Robot Description Format."""
