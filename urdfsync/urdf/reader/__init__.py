"""XML to robot, in parts: strict parsing, typed fields, links, joints, checks, and the second reader."""
