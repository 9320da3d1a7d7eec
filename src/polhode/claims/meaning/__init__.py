"""What the letters and phrases of a text mean in a model."""
