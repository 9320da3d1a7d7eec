"""Documents of claims, and reports of their audits."""
