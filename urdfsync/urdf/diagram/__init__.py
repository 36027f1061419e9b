"""The diagram of the robot model: layout, routing, and the same as a picture."""
