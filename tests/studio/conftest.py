"""What the tests of the studio share."""

from page_fixtures import browser, line, page_is_built, plain_browser, studio  # noqa: F401
