"""The meaning of the letters and phrases of a text in a model."""
