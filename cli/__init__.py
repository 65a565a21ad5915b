"""The ``towtank`` command."""
