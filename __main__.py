"""``python -m towtank``."""

from .cli.main import main

main()
