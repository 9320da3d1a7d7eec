"""Documents of claims, and what came of their audit."""
