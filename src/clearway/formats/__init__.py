"""The files: scenarios, plans and traces."""
