"""Published derivative sets and captive tables as data, with their ships, conventions, sources and misprints.

Each file in ``papers/`` holds one paper: what it prints, as it prints it, and beside it what is known to be
wrong. The loaders give derivative sets and tables ready for use, corrected unless asked otherwise.

>>> from towtank.datasets import load_set
>>> load_set("s175")["Nrrr"], load_set("s175", corrected=False)["Nrrr"]
(-0.0422, -0.422)
"""

from .sets import list_sets, load_extras, load_set
from .tables import PublishedTable, list_tables, load_table

__all__ = ["PublishedTable", "list_sets", "list_tables", "load_extras", "load_set", "load_table"]
