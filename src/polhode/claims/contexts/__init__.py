"""The contexts of claims, and how a claim is judged in each."""
