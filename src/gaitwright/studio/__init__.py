"""A page in the browser from which a person watches, drives and teaches a robot (rows S1–S6)."""
