"""What follows from a wrong line, by the text's own equations and the laws of the model."""
