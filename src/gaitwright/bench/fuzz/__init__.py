"""Seed → files and command lines that somebody damaged, and what became of each: a sentence, or our fault.

`originals` are sound, `mutations` damages them, `kinds` takes them as a user's, `worker` does so one by one,
in a process of its own, and `hunt` watches over that.
"""
