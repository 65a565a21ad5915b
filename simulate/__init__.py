"""The reference manoeuvring simulator: models, manoeuvres, indices, criteria, ensembles."""
