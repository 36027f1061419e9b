"""`urdfsync watch`: the daemon that builds when sources, templates or the configuration change."""
