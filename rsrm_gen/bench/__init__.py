"""Measurements that anyone can repeat: accuracy beside other tools on the same points, and the time of generation."""
