"""A fleet that exists only here: a scenario run through time, seeded and repeatable."""
