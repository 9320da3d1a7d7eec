"""How expressions print: laid out once, then written as text or LaTeX."""
