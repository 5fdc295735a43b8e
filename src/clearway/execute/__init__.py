"""Letting committed motion happen, in the plan's order of passage, when robots are late."""
