"""`python -m gaitwright` is the command `gaitwright`."""

import sys

from gaitwright.cli import main

if __name__ == "__main__":
    sys.exit(main())
