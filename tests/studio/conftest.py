"""What the tests of the studio share."""

import pytest
from page_fixtures import browser, line, page_is_built, plain_browser, studio  # noqa: F401


@pytest.fixture
def said() -> list[dict]:
    """What a room says to everybody."""
    return []
