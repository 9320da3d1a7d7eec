"""A line of a text: what it may mean, whether it holds in that meaning, and what it states."""
