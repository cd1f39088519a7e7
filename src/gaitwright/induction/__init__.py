"""Labelled cases → the shortest ordered list of rules that says them: columns, bounds and order are found."""
