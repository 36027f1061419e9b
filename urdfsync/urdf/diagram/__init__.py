"""The diagram of the robot model: its layout, the routing of its lines, and its drawing as SVG."""
