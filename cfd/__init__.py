"""CFD campaigns: from solver logs to settled loads, sweeps of cases, and derivatives with numerical uncertainty."""
