"""The diagram of the robot model: layout, lines, and drawing as SVG."""
