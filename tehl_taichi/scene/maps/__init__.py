"""Measured heights: reading, levelling, filtering, judging."""
