"""Free decay in roll, heave and pitch: from a record to damping with its uncertainty."""
