"""`urdfsync check`: compiles packages, and compares them with an independent reference."""
