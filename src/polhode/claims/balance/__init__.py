"""The balance of every body by numbers: what a second opinion is made of."""
