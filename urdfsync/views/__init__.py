"""How results look; with `report`, the only place that knows rich."""
