"""Pictures and pages of plans, for people."""
