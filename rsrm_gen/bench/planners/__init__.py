"""Sampling planners of OMPL beside the descent of a trained field, on the same scenes and judged by the same measure."""
