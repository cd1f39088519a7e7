"""One module per claim; `measure` yields its figures."""
