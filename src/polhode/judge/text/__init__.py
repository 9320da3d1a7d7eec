"""What the words of a text say of the relations among them, and what it has stated so far."""
