"""Judgements about a legal robot: bodies, joints and shapes that no real robot has.

Each judgement is a pure function of the robot. The bounds are wide, since a warning about a sound robot is worse than
no warning.
"""
