"""Builds the studio's page into a wheel, so that who installs one needs no Node."""

import sys
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class PageHook(BuildHookInterface):
    """Runs before a wheel is made; a clone installed in place builds its page when the studio is opened."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Puts the built page among what goes into the wheel."""
        if version == "editable":
            return
        sys.path.insert(0, str(Path(self.root) / "src"))
        from gaitwright.studio.page_build import ready_page  # noqa: PLC0415 - found since the line before

        page = ready_page(print).relative_to(self.root)
        build_data["artifacts"].append(f"{page}/**")
