"""`urdfsync check`: packages are read, compiled, and compared with an independent reference."""
