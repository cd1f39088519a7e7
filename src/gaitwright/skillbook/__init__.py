"""Skillbook ↔ file: what was taught, and what it made, in one SQLite file that no kill damages.

`Skillbook` is the value, `open_for_learning` the one way to add to a file; `learning.merging` joins two.
"""

from gaitwright.skillbook.book import Skillbook as Skillbook
from gaitwright.skillbook.book import content_hash as content_hash
from gaitwright.skillbook.book import export_text as export_text
from gaitwright.skillbook.book import import_text as import_text
from gaitwright.skillbook.writer import Ledger as Ledger
from gaitwright.skillbook.writer import open_for_learning as open_for_learning
